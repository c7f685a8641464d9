"""CalculiX input file of the static press. Units of the file: mm, N, MPa."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from contactstudy.arrays import Array, IntArray
from contactstudy.export.press_mesh import PressMesh
from contactstudy.validation import positive, raise_if

UNITS = "mm, N, MPa"


@dataclass(frozen=True)
class PressLoading:
    """How a wheel is pressed on its rail.

    Attributes
    ----------
    load : float
        Vertical wheel load in N; of both halves, so that half of it acts on a half model.
    penalty : float
        Pressure per penetration in Pa/m.
    start : float
        Displacement of the hub in the first step in m, enough to bring some faces together.
    repeats : int
        Further steps at the same load. CalculiX pairs the faces once a step, as the bodies stand
        at its beginning; where an inclined force moves these sideways, the pairs are right only
        once a step moves them no more. What `start` was then no longer shows.

    Raises
    ------
    InputError
        If load, penalty or start is not positive.
    """

    load: float
    penalty: float
    start: float
    repeats: int = 0

    def __post_init__(self) -> None:
        raise_if(
            positive("load", self.load, "N")
            + positive("penalty", self.penalty, "Pa/m")
            + positive("start", self.start, "m")
        )


def calculix_input(
    mesh: PressMesh,
    loading: PressLoading,
    youngs_modulus: float,
    poisson_ratio: float,
    header: Sequence[str] = (),
) -> str:
    """Text of an input file that presses the wheel on the rail with a load on its hub.

    The contact pressure is taken face to face (``SURFACE TO SURFACE``): CalculiX cuts the tread's
    faces with the rail's and integrates on the pieces. Unlike the program it takes the gap between
    the flat faces, not between the smooth profiles. The first step only closes the gap, so that the
    hub, which nothing but the contact holds, does not fall in the second.

    The elastic constants are those of both bodies, E in Pa; `header` are comment lines.
    """
    held = (*("SYMMETRY, 2, 2",) * mesh.symmetric, "ENDS, 1, 3", "BORE, 1, 2")
    share, whose = (0.5, ", half of it on this half model") if mesh.symmetric else (1.0, "")
    press = [
        f"** the wheel load on the hub{whose}",
        "*STEP",
        "*STATIC",
        "*BOUNDARY, OP=NEW",
        *held,
        "*CLOAD",
        f"HUB, 3, {-share * loading.load:.12g}",
        "*NODE PRINT, NSET=HUB",
        "U",
        "*CONTACT PRINT",
        "CSTR, CELS",
        "*CONTACT PRINT, SLAVE=TREAD, MASTER=RUNNING",
        "CF",
        "*NODE FILE",
        "U",
        "*EL FILE",
        "S",
        "*END STEP",
    ]
    lines = [
        *(f"** {line}".rstrip() for line in header),
        f"** units: {UNITS}",
        *_mesh(mesh),
        "*MATERIAL, NAME=STEEL",
        "*ELASTIC",
        f"{1e-6 * youngs_modulus:.12g}, {poisson_ratio:.12g}",
        "*SOLID SECTION, ELSET=RAIL, MATERIAL=STEEL",
        "*SOLID SECTION, ELSET=WHEEL, MATERIAL=STEEL",
        "*SURFACE INTERACTION, NAME=PENALTY",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        f"{1e-9 * loading.penalty:.12g}",  # 1 Pa/m = 1e-9 MPa/mm
        "*CONTACT PAIR, INTERACTION=PENALTY, TYPE=SURFACE TO SURFACE",
        "TREAD, RUNNING",
        *_hub(mesh.bore),
        "** the hub comes down by a given amount, to close the gap",
        "*STEP",
        "*STATIC",
        "*BOUNDARY",
        *held,
        f"HUB, 3, 3, {-1e3 * loading.start:.6g}",
        "*CONTACT PRINT",  # CalculiX wants energies from the first step on
        "CELS",
        "*END STEP",
        *press * (1 + loading.repeats),
    ]
    return "\n".join(lines) + "\n"


def _mesh(mesh: PressMesh) -> Iterator[str]:
    yield from node_lines(mesh.nodes)
    first = 1
    for name, elements in (("RAIL", mesh.rail), ("WHEEL", mesh.wheel)):
        yield from element_lines(name, elements, first)
        first += len(elements)
    for name, nodes in (
        *((("SYMMETRY", mesh.symmetry),) * mesh.symmetric),
        ("ENDS", mesh.rail_ends),
        ("BORE", mesh.bore),
        ("HUB", mesh.bore[:1]),
    ):
        yield from set_lines(name, nodes)
    for name, faces in (("TREAD", mesh.tread), ("RUNNING", mesh.running_surface)):
        yield f"*SURFACE, NAME={name}, TYPE=ELEMENT"
        for element, face in (faces + 1).tolist():
            yield f"{element}, S{face}"


def node_lines(nodes: Array) -> Iterator[str]:
    """Nodes (n, 3) [m], from number 1 on."""
    yield "*NODE, NSET=ALL"
    for i, (x, y, z) in enumerate((1e3 * nodes).tolist(), 1):
        yield f"{i}, {x:.12g}, {y:.12g}, {z:.12g}"


def element_lines(name: str, elements: IntArray, first: int) -> Iterator[str]:
    """Incompatible-mode bricks of nodes (m, 8) counted from 0, numbered from `first` on."""
    yield f"*ELEMENT, TYPE=C3D8I, ELSET={name}"
    for i, row in enumerate((elements + 1).tolist(), first):
        yield f"{i}, " + ", ".join(map(str, row))


def set_lines(name: str, nodes: IntArray) -> Iterator[str]:
    """A named set of nodes (k,), counted from 0."""
    yield f"*NSET, NSET={name}"
    for i in range(0, len(nodes), 10):
        yield ", ".join(map(str, (nodes[i : i + 10] + 1).tolist())) + ","


def _hub(bore: IntArray) -> Iterator[str]:
    """The bore moves vertically as one: u_z of every node is that of the first."""
    hub, *others = (bore + 1).tolist()
    for node in others:
        yield from ("*EQUATION", "2", f"{node}, 3, 1., {hub}, 3, -1.")
