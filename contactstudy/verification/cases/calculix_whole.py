"""Static presses of whole sections against CalculiX: S1002 on inclined 60E1."""

from dataclasses import replace

import numpy as np

from contactstudy.contact.groups import contact_area
from contactstudy.export.calculix import calculix_input
from contactstudy.export.press_mesh import press_mesh
from contactstudy.export.run_calculix import run_calculix
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.tread import wheel_points
from contactstudy.profiles.rail import rail_profile
from contactstudy.solids.bodies import wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.solvers.surface import geometry_press
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.vehicles import vehicle
from contactstudy.study.loading import load_study
from contactstudy.track.model import Track
from contactstudy.track.solid import solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.verification.cases.calculix import compared, pressures_apart, read_as_facets
from contactstudy.verification.cases.facets import FacetPress, facet_press
from contactstudy.verification.check import CaseResult, Check, Table

STUDY = "s1002_inclined"
CHANGES = (
    "solid.mesh_size=4 mm",
    "solid.contact_half_width=16 mm",
    "solid.penalty=1e14 Pa/m",
)
LENGTH = 0.1
"""m of rail."""
BANDS = 1e-3, 0.02, 0.01
"""Of approach, area and peak pressure."""
START = 110e-6
"""m that the hub comes down in CalculiX's first step; the result does not depend on it."""

METHOD = """\
The wheel of the study {study}, {placed}, is pressed on the middle of a rail \
{length:g} m long, clamped at both ends; whole sections of {size:g} mm elements, {load:.5g} kN. \
CalculiX solves the exported mesh ({nodes} nodes) in track axes, the hub moving along Z only, \
contact frictionless and face to face.

The penalty is a hundredth of the default, for both. On so coarse a mesh the flat faces of the two \
bodies meet at crossings of their ridges; with a stiff penalty all the pressure stands in a few \
spots there and hangs on where either program has its integration points. "Flat faces" and "smooth \
profiles" are what they are in the case calculix_coarse, with the rail's nodes all kept and the \
wheel condensed; smooth profiles are reported and not judged.

The program is linear: normals and places of the undeformed bodies. CalculiX pairs the faces where \
the first step has moved them: the wheel's rim gives way sideways.
"""


CORNER = """
As drawn the wheel touches at the gauge corner alone. The inclined force pushes rail and rim apart
until the tread carries as well, in both programs. On faces of 4 mm the two patches are one or two
faces wide; approach, area and single pressures are reported, and how much of the pressure stands
below s = -26 mm, on the gauge corner. Judged is the lateral force. CalculiX follows the faces as
they move sideways, which the linear program does not.
"""
GAUGE_CORNER = -0.026
"""Arc length on the wheel's profile in m that divides the patches."""


def press_with_yaw() -> CaseResult:
    """4 mm on 0.1 m of rail; about a minute of CalculiX."""
    study = load_study(STUDY, (*CHANGES, "wheelset.yaw=5 mrad"))
    return _press("calculix_whole", study, "turned by a yaw of 5 mrad", "whole sections", BANDS)


def press_on_gauge_corner() -> CaseResult:
    """The same with two patches."""
    study = load_study(STUDY, (*CHANGES, "wheelset.lateral_shift=5.5 mm"))
    placed = "5.5 mm to the side"
    return _press("calculix_corner", study, placed, "tread and gauge corner", None)


def _press(
    name: str,
    study: Study,
    standing: str,
    title: str,
    bands: tuple[float, float, float] | None,
) -> CaseResult:
    """One press in both programs; without bands the share of the gauge corner is compared."""
    cell, placed = build.recipe(study), geometry(study)
    # wide steps far from the contact: quicker, and the same for both programs
    recipe = replace(build.wheel_recipe(study), far_step=np.pi / 6)
    penalty, load = study.solid.penalty, float(vehicle(study).static_loads[0])
    mesh = press_mesh(cell, recipe, LENGTH, placed)
    material = cell.youngs_modulus, cell.poisson_ratio
    run = run_calculix(calculix_input(mesh, load, penalty, *material, START), penalty, False)
    theirs = read_as_facets(mesh, run)

    track = UnreducedTrack(Track(rail=solid_rail(cell), length=LENGTH, support=None), cell)
    wheel = cached(wheel_body(recipe))
    flat = facet_press(track, wheel, load, penalty, 0.5 * LENGTH, geometry=placed)
    smooth = _smooth(track, wheel, load, penalty, placed)
    source = f"CalculiX {run.version}"
    apart = pressures_apart(flat, theirs, source) if bands else _share(wheel, flat, theirs, source)
    checks = (
        Check("vertical contact force", 1e-3 * load, 1e-3 * run.press.force, "kN", source, 1e-3),
        _lateral("flat faces", flat, theirs, source, 0.03),
        *compared("flat faces", flat, theirs, source, bands or (None, None, None)),
        apart,
        _lateral("smooth profiles", smooth, theirs, source, None),
        *compared("smooth profiles", smooth, theirs, source, (None, None, None)),
    )
    return CaseResult(
        name=name,
        title=f"S1002 on inclined {rail_profile(cell.profile).name} in CalculiX: {title}",
        method=METHOD.format(
            study=STUDY,
            placed=standing,
            length=LENGTH,
            size=1e3 * cell.size,
            load=1e-3 * load,
            nodes=len(mesh.nodes),
        )
        + ("" if bands else CORNER),
        checks=checks,
        tables=(_pressures(wheel, flat, smooth, theirs, source),),
    )


def _share(wheel: WheelFlexibility, ours: FacetPress, theirs: FacetPress, source: str) -> Check:
    """Part of the faces' pressures that stands on the gauge corner."""
    below = 0.5 * (wheel.y[1:] + wheel.y[:-1]) < GAUGE_CORNER

    def share(press: FacetPress) -> float:
        return float(press.face_pressure[:, below].sum() / press.face_pressure.sum())

    return Check(
        "share of the gauge corner, flat faces", share(ours), share(theirs), "", source, None
    )


def _lateral(
    how: str, ours: FacetPress, theirs: FacetPress, source: str, band: float | None
) -> Check:
    forces = 1e-3 * ours.lateral_force, 1e-3 * theirs.lateral_force
    return Check(f"lateral force on the wheel, {how}", *forces, "kN", source, band)


def _smooth(
    track: UnreducedTrack, wheel: WheelFlexibility, load: float, penalty: float, placed: Geometry
) -> FacetPress:
    """The program's own press."""
    points = wheel_points(wheel, "gauss", placed)
    curve = geometry_press(track, wheel, np.array([load]), penalty, 0.5 * LENGTH, geometry=placed)
    solution = curve.solutions[0]
    shape = len(wheel.x) - 1, 2, len(wheel.y) - 1, 2
    force, area = (
        values.reshape(shape).sum(axis=(1, 3)) for values in (solution.forces, points.area)
    )
    normal = placed.pose.track_of_rail(placed.rail.normal(points.arc))
    sideways = solution.forces.reshape(len(points.x), -1).sum(axis=0) @ normal[:, 0]
    # not the curve's approach: that is measured to the rail's centre line
    patch = contact_area(points, curve.gaps[0], solution.forces)
    return FacetPress(solution.approach, patch, force / area, float(sideways))


def _pressures(
    wheel: WheelFlexibility, flat: FacetPress, smooth: FacetPress, theirs: FacetPress, source: str
) -> Table:
    """Faces across the tread, just ahead of the middle."""
    middle = len(wheel.x) // 2
    centre = 0.5 * (wheel.y[1:] + wheel.y[:-1])
    columns = (theirs, flat, smooth)
    rows = tuple(
        (1e3 * float(s), *(1e-6 * float(p.face_pressure[middle, j]) for p in columns))
        for j, s in enumerate(centre)
    )
    header = ("s of the face (mm)", f"{source} (MPa)", "flat faces (MPa)", "smooth (MPa)")
    return Table("Mean pressure of the faces ahead of the wheel's lowest point", header, rows)
