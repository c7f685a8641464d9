"""Rail and wheel in section, deformed: drawn where a run carries the meshes of both."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from contactstudy.figures.drawing import Drawing, FloatArray, exact, label, number
from contactstudy.figures.style import BLACK, GREY, new_figure
from contactstudy.study.results import StudyResults

# Displacements are drawn so that the largest is this part of the rail's height.
_DRAWN_SHARE = 0.06
_NEAR = 20.0  # mm, half width of the enlarged part


@dataclass(frozen=True)
class Section:
    """One body in the plane across the rail, in m, y lateral and z up.

    Attributes
    ----------
    nodes : (n, 2) array
    quads : (m, 4) array of int
    displacement : (n, 2) array
    """

    nodes: FloatArray
    quads: np.ndarray
    displacement: FloatArray


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for the first run that carries section meshes, else none."""
    for name, run in results.runs.items():
        rail = section_of(run, "rail")
        if rail is None:
            continue
        wheel = section_of(run, "wheel")
        factor = magnification(rail, wheel)
        return [
            Drawing(
                "deformed_section",
                _caption(name, run, rail, wheel, factor),
                lambda rail=rail, wheel=wheel, factor=factor: _draw(rail, wheel, factor),  # type: ignore[misc]
            )
        ]
    return []


def section_of(run: xr.Dataset, body: str) -> Section | None:
    """Section mesh of `body` ("rail" or "wheel"), mirrored to y < 0 when only half is modelled."""
    names = [f"section_{body}_{part}" for part in ("nodes", "quads", "displacement")]
    if not all(name in run for name in names):
        return None
    nodes, quads, moved = (np.asarray(run[name].values) for name in names)
    quads = quads.astype(int)
    if nodes[:, 0].min() >= -1e-9:
        flip = np.array([-1.0, 1.0])
        quads = np.concatenate([quads, quads[:, ::-1] + len(nodes)])
        nodes, moved = np.concatenate([nodes, nodes * flip]), np.concatenate([moved, moved * flip])
    return Section(nodes, quads, moved)


def magnification(rail: Section, wheel: Section | None) -> float:
    """Return a round factor (1, 2 or 5 times a power of ten) by which displacements are drawn.

    Only what deforms is magnified: each body's mean displacement is drawn with the same factor,
    so that the bodies stay in touch.
    """
    bodies = [rail] if wheel is None else [rail, wheel]
    largest = max(float(np.abs(b.displacement).max()) for b in bodies)
    if largest == 0.0:
        return 1.0
    height = float(np.ptp(rail.nodes[:, 1]))
    wanted = _DRAWN_SHARE * height / largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(max(s * decade for s in (1.0, 2.0, 5.0) if s * decade <= wanted * (1 + 1e-9)))


def _draw(rail: Section, wheel: Section | None, factor: float) -> Figure:
    figure = new_figure(4.2, equal_axes=True)
    whole, near = figure.subplots(1, 2, width_ratios=[1.0, 1.25])
    bodies = [rail] if wheel is None else [rail, wheel]
    low = min(b.displacement[:, 1].min() for b in bodies) * 1e3
    high = max(b.displacement[:, 1].max() for b in bodies) * 1e3
    for body in bodies:
        _outline(whole, body)
        _body(whole, body, factor, (low, high))
        _outline(near, body)
        image = _body(near, body, 1.0, (low, high))
    figure.colorbar(image, ax=near, label="Vertical displacement (mm)", shrink=0.8)
    whole.autoscale_view()
    near.set_xlim(-_NEAR, _NEAR)
    near.set_ylim(-1.5 * _NEAR, 0.9 * _NEAR)
    whole.set_title(f"Displacements × {exact(factor)}")
    near.set_title("Near the contact, true to scale")
    for axes in (whole, near):
        axes.set_aspect("equal")
        axes.set_xlabel("Across the rail y (mm)")
        axes.grid(False)
    whole.set_ylabel("Height z above the running surface (mm)")
    return figure


def _body(axes: Axes, body: Section, factor: float, limits: tuple[float, float]) -> PolyCollection:
    corners = (body.nodes + factor * body.displacement)[body.quads] * 1e3
    value = body.displacement[:, 1][body.quads].mean(axis=1) * 1e3
    faces = PolyCollection(
        list(corners), array=value, cmap="cividis", edgecolors=BLACK, linewidths=0.08
    )
    faces.set_clim(*limits)
    axes.add_collection(faces)
    return faces


def _outline(axes: Axes, body: Section) -> None:
    """Undeformed edge: the element sides that occur once."""
    sides = np.concatenate([body.quads[:, [i, (i + 1) % 4]] for i in range(4)])
    # A half model's plane of symmetry is inside the whole body.
    inner = np.all(np.abs(body.nodes[sides, 0]) < 1e-9, axis=1)
    keys, index, count = np.unique(
        np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True
    )
    edge = sides[index[count == 1]]
    edge = edge[~inner[index[count == 1]]] if keys.size else edge
    lines = body.nodes[edge] * 1e3
    axes.add_collection(
        PolyCollection(
            list(lines), closed=False, facecolors="none", edgecolors=GREY, linewidths=0.7
        )
    )


def _caption(
    name: str, run: xr.Dataset, rail: Section, wheel: Section | None, factor: float
) -> str:
    where = ""
    at = run.attrs.get("section_position")
    if at is not None:
        where = f" at X = {exact(float(at))} m"
    down = -rail.displacement[:, 1] * 1e3
    bodies = "the rail" if wheel is None else "rail and wheel"
    text = (
        f"Section through {bodies} under the wheel of the run {label(name)}{where}: left with "
        f"displacements drawn {exact(factor)} times, right near the contact and true to scale; "
        "grey the undeformed outline. The rail moves down by "
        f"{number(down.min())} to {number(down.max())} mm"
    )
    if wheel is not None:
        text += (
            f", the shown part of the wheel by {number(-wheel.displacement[:, 1].max() * 1e3)} to "
            f"{number(-wheel.displacement[:, 1].min() * 1e3)} mm"
        )
    return text + "."
