"""The static press against CalculiX, an independent finite-element program, on the same mesh."""

import numpy as np

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import press_mesh
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.profiles.rail import rail_profile
from contactstudy.solids.bodies import rail_body, wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.track.meshed import MeshedTrack
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.vehicle import wheel_column
from contactstudy.verification.cases.calculix_faces import (
    PEAK,
    press_checks,
    pressure_table,
    pressures_apart,
    read_as_facets,
    smooth_press,
)
from contactstudy.verification.cases.flat_press import flat_press
from contactstudy.verification.cases.run_calculix import run_calculix
from contactstudy.verification.check import CaseResult, check_shown

LOAD = float(wheel_column().static_loads[0])
"""N, static load of the default wheel."""
PENALTY = 1e16

METHOD = """\
A wheel is pressed on the middle of a rail {length:g} m long, clamped at both ends; elements of \
{size:g} mm, {load:.5g} kN. CalculiX solves the exported mesh with every node kept ({nodes} nodes, \
incompatible-mode bricks, contact face to face with the same penalty, load on the hub). The \
approach is the hub's displacement against the clamped ends; the area that of the integration \
points in contact; pressures are means over the tread's faces, which no extrapolation to nodes \
distorts; the difference of the pressures is the root mean square over the faces, relative to that \
of CalculiX's.

"Flat faces": {model}, its gap and displacements linear between the nodes as CalculiX has them; \
what differs is elements, condensation, contact algorithm and integration points. "Smooth \
profiles": the press as the program runs it, 2 x 2 Gauss points a face, the gap between the smooth \
profiles, the area from the gap around the patch. The sagitta of the faces, {sagitta:.2g} µm, is \
what the two differ by: with so few faces over a patch it moves single points into contact and \
single pressures by a tenth, so these are reported beside Hertz and not judged; how they converge \
is the subject of other cases."""


def press_on_default_mesh() -> CaseResult:
    """Condensed bodies of the default mesh, 2 mm, on 0.4 m of rail; minutes of CalculiX."""
    return _case("calculix", CellRecipe(), WheelRecipe(), 0.4, reduced=True)


def press_on_coarse_mesh() -> CaseResult:
    """4 mm on 0.08 m of rail with every node kept: quick."""
    wheel = WheelRecipe(size=0.004, far_step=np.pi / 6)
    return _case("calculix_coarse", CellRecipe(size=0.004, length=0.08), wheel, 0.08, reduced=False)


def _track(cell: CellRecipe, length: float, reduced: bool) -> MeshedTrack:
    """The short clamped rail, without supports."""
    rail = Track(rail=solid_rail(cell), length=length, support=None)
    if reduced:
        return SolidTrack(rail, cached(rail_body(cell)), mean_phase=False)
    return UnreducedTrack(rail, cell)


def _case(
    name: str, cell: CellRecipe, recipe: WheelRecipe, length: float, reduced: bool
) -> CaseResult:
    mesh, track = press_mesh(cell, recipe, length), _track(cell, length, reduced)
    wheel, material = cached(wheel_body(recipe)), (cell.youngs_modulus, cell.poisson_ratio)
    radius, crown = recipe.dimensions.radius, rail_profile(cell.profile).crown_radius
    hertz = hertz_contact(LOAD, contact_modulus(*material), radius, crown)
    loading = PressLoading(LOAD, PENALTY, hertz.approach)
    run = run_calculix(calculix_input(mesh, loading, *material), PENALTY)
    at = SurfaceContact(wheel, penalty=PENALTY), LOAD, 0.5 * length
    flat, smooth = flat_press(track, *at), smooth_press(track, *at)
    theirs = read_as_facets(mesh, run.press)
    peak, against = float(smooth.face_pressure.max()), "smooth profiles, against Hertz's"
    source, outwards = f"CalculiX {run.version}", slice(len(wheel.x) // 2, None)
    checks = (
        check_shown("vertical contact force", LOAD, run.press.force, "kN", source, 1e-3),
        *press_checks("flat faces", flat, theirs, source, (1e-3, 0.02, 0.01)),
        pressures_apart(flat, theirs, source),
        *press_checks(
            "smooth profiles", smooth, theirs, source, (0.01 if reduced else None, None, None)
        ),
        check_shown(f"{PEAK}, {against} p0", peak, hertz.peak_pressure, "MPa", "Hertz", None),
        check_shown(f"area, {against}", smooth.area, hertz.area, "mm²", "Hertz", None),
    )
    h = cell.size
    return CaseResult(
        name=name,
        title=f"Static press on the mesh of {1e3 * h:g} mm against CalculiX",
        method=METHOD.format(
            length=length,
            size=1e3 * h,
            load=1e-3 * LOAD,
            nodes=len(mesh.nodes),
            model="the condensed bodies" if reduced else "the rail with every node kept",
            sagitta=1e6 * h**2 / 8 * (1 / radius + 1 / crown),
        ),
        checks=checks,
        tables=(
            pressure_table(
                "Mean pressure of the faces next to the plane of symmetry",
                "x of the face (mm)",
                0.5 * (wheel.x[1:] + wheel.x[:-1])[outwards],
                {
                    source: theirs.face_pressure[outwards, 0],
                    "flat faces": flat.face_pressure[outwards, 0],
                    "smooth": smooth.face_pressure[outwards, 0],
                },
            ),
        ),
    )
