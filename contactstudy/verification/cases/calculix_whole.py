"""Static press of whole sections against CalculiX: S1002 with yaw on inclined 60E1."""

from dataclasses import dataclass, replace

import numpy as np

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import press_mesh
from contactstudy.solids.bodies import wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.loading import load_study
from contactstudy.track.model import Track
from contactstudy.track.solid import solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.verification.cases.calculix_faces import (
    press_checks,
    pressure_table,
    pressures_apart,
    read_as_facets,
    smooth_press,
)
from contactstudy.verification.cases.flat_press import FacetPress, flat_press
from contactstudy.verification.cases.run_calculix import run_calculix
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

STUDY = "s1002_inclined"
SIZE, LENGTH = 4e-3, 0.1
"""Of the elements and of the rail in m."""
CHANGES = (
    f"solid.mesh_size={SIZE!r}",
    "solid.contact_half_width=16 mm",
    "solid.penalty=1e14 Pa/m",
)
START = 110e-6
"""m that the hub comes down in CalculiX's first step."""

METHOD = """\
The wheel of the study {study}, {placed}, is pressed on the middle of a rail \
{length:g} m long, clamped at both ends; whole sections of {size:g} mm elements, {load:.5g} kN. \
CalculiX solves the exported mesh ({nodes} nodes) in track axes, the hub moving along Z only, \
contact frictionless and face to face.

The penalty is a hundredth of the default, for both. On so coarse a mesh the flat faces of the two \
bodies meet at crossings of their ridges; with a stiff penalty all the pressure stands in a few \
spots there and depends on where either program has its integration points. "Flat faces" and \
"smooth profiles" are what they are in the case calculix_coarse, with the rail's nodes all kept \
and the wheel condensed; smooth profiles are reported and not judged.

The program is linear: normals and places of the undeformed bodies. CalculiX pairs the faces where \
the step before has moved them: the wheel's rim gives way sideways."""


@dataclass(frozen=True)
class WholePress:
    """A press of whole sections by both programs.

    Attributes
    ----------
    steps : tuple of FacetPress
        Of CalculiX's load steps.
    load, force : float
        Of the wheel, and what CalculiX has between the surfaces, vertical, in N.
    nodes : int
        Of CalculiX's mesh.
    """

    steps: tuple[FacetPress, ...]
    flat: FacetPress
    smooth: FacetPress
    wheel: WheelFlexibility
    load: float
    force: float
    nodes: int
    source: str

    @property
    def theirs(self) -> FacetPress:
        """CalculiX's last step."""
        return self.steps[-1]

    def method(self, placed: str) -> str:
        """What is computed, for a wheel placed so."""
        return METHOD.format(
            study=STUDY,
            placed=placed,
            length=LENGTH,
            size=1e3 * SIZE,
            load=1e-3 * self.load,
            nodes=self.nodes,
        )

    def vertical(self) -> Check:
        """Whether the load is reached."""
        force = "vertical contact force"
        return check_shown(force, self.load, self.force, "kN", self.source, 1e-3)

    def lateral(self, how: str, ours: FacetPress, band: float | None = None) -> Check:
        """Lateral force on the wheel."""
        forces = ours.lateral_force, self.theirs.lateral_force
        return check_shown(f"lateral force on the wheel, {how}", *forces, "kN", self.source, band)

    def table(self) -> ResultTable:
        """Pressures across the tread, just ahead of the middle."""
        middle, y = len(self.wheel.x) // 2, self.wheel.y
        presses = {self.source: self.theirs, "flat faces": self.flat, "smooth": self.smooth}
        return pressure_table(
            "Mean pressure of the faces ahead of the wheel's lowest point",
            "s of the face (mm)",
            0.5 * (y[1:] + y[:-1]),
            {name: press.face_pressure[middle] for name, press in presses.items()},
        )


def whole_press(*changes: str, start: float = START, repeats: int = 0) -> WholePress:
    """Press the study's wheel, with keys as ``key=value``, by both programs.

    `start` and `repeats` are those of `PressLoading`.
    """
    study = load_study(STUDY, (*CHANGES, *changes))
    cell, placed = build.recipe(study), geometry(study)
    # wide steps far from the contact: quicker, and the same for both programs
    recipe = replace(build.wheel_recipe(study), far_step=np.pi / 6)
    penalty, load = study.solid.penalty, study.vehicle.static_load
    mesh = press_mesh(cell, recipe, LENGTH, placed)
    material = cell.youngs_modulus, cell.poisson_ratio
    loading = PressLoading(load, penalty, start, repeats)
    run = run_calculix(calculix_input(mesh, loading, *material), penalty, False)
    track = UnreducedTrack(Track(rail=solid_rail(cell), length=LENGTH, support=None), cell)
    wheel = cached(wheel_body(recipe))
    at = SurfaceContact(wheel, placed, penalty=penalty), load, 0.5 * LENGTH
    return WholePress(
        steps=tuple(read_as_facets(mesh, press) for press in run.presses),
        flat=flat_press(track, *at),
        smooth=smooth_press(track, *at),
        wheel=wheel,
        load=load,
        force=run.press.force,
        nodes=len(mesh.nodes),
        source=f"CalculiX {run.version}",
    )


def press_with_yaw() -> CaseResult:
    """4 mm on 0.1 m of rail; about a minute of CalculiX."""
    found = whole_press("wheelset.yaw=5 mrad")
    flat, smooth, theirs = found.flat, found.smooth, found.theirs
    checks = (
        found.vertical(),
        found.lateral("flat faces", flat, 0.03),
        *press_checks("flat faces", flat, theirs, found.source, (1e-3, 0.02, 0.01)),
        pressures_apart(flat, theirs, found.source),
        found.lateral("smooth profiles", smooth),
        *press_checks("smooth profiles", smooth, theirs, found.source, (None, None, None)),
    )
    return CaseResult(
        name="calculix_whole",
        title="S1002 on inclined 60E1 in CalculiX: whole sections",
        method=found.method("turned by a yaw of 5 mrad"),
        checks=checks,
        tables=(found.table(),),
    )
