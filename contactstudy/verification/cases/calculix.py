"""The static press against CalculiX, an independent finite-element program, on the same mesh."""

from dataclasses import dataclass

import numpy as np

from contactstudy.contact.groups import contact_area
from contactstudy.export.calculix import calculix_input
from contactstudy.export.press_mesh import PressMesh, press_mesh
from contactstudy.export.run_calculix import CalculixRun, run_calculix
from contactstudy.geometry.tread import wheel_points
from contactstudy.halfspace.hertz import HertzContact, contact_modulus, hertz_contact
from contactstudy.profiles.rail import rail_profile
from contactstudy.solids.bodies import rail_body, wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solvers.surface import geometry_press
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.vehicle import wheel_column
from contactstudy.verification.cases.facets import FacetPress, facet_press
from contactstudy.verification.check import CaseResult, Check, Table

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
profiles, the area from the gap around the patch. The sagitta of the faces, {sagitta:.2g} um, is \
what the two differ by: with so few faces over a patch it moves single points into contact and \
single pressures by a tenth, so these are reported beside Hertz and not judged; how they converge \
is the subject of other cases."""


@dataclass(frozen=True)
class _Model:
    """Bodies of a case."""

    cell: CellRecipe
    wheel: WheelRecipe
    length: float
    reduced: bool

    @property
    def track(self) -> SolidTrack | UnreducedTrack:
        """The short clamped rail, without supports."""
        rail = Track(rail=solid_rail(self.cell), length=self.length, support=None)
        if self.reduced:
            return SolidTrack(rail, cached(rail_body(self.cell)), mean_phase=False)
        return UnreducedTrack(rail, self.cell)

    @property
    def mesh(self) -> PressMesh:
        """The same as one mesh."""
        return press_mesh(self.cell, self.wheel, self.length)

    def calculix(self, mesh: PressMesh) -> CalculixRun:
        """Let CalculiX solve it."""
        E, nu = self.cell.youngs_modulus, self.cell.poisson_ratio
        text = calculix_input(mesh, LOAD, PENALTY, E, nu, self.hertz.approach)
        return run_calculix(text, PENALTY)

    @property
    def hertz(self) -> HertzContact:
        """The same contact in closed form."""
        modulus = contact_modulus(self.cell.youngs_modulus, self.cell.poisson_ratio)
        crown = rail_profile(self.cell.profile).crown_radius
        return hertz_contact(LOAD, modulus, self.wheel.dimensions.radius, crown)


def press_on_default_mesh() -> CaseResult:
    """Condensed bodies of the default mesh, 2 mm, on 0.4 m of rail; minutes of CalculiX."""
    model = _Model(CellRecipe(), WheelRecipe(), 0.4, reduced=True)
    return _case("calculix", model, 0.01)


def press_on_coarse_mesh() -> CaseResult:
    """4 mm on 0.08 m of rail with every node kept: quick."""
    wheel = WheelRecipe(size=0.004, far_step=np.pi / 6)
    model = _Model(CellRecipe(size=0.004, length=0.08), wheel, 0.08, reduced=False)
    return _case("calculix_coarse", model, None)


def _case(name: str, model: _Model, smooth_band: float | None) -> CaseResult:
    mesh, track = model.mesh, model.track
    wheel = cached(wheel_body(model.wheel))
    run, middle = model.calculix(mesh), 0.5 * model.length
    flat = facet_press(track, wheel, LOAD, PENALTY, middle)
    theirs = read_as_facets(mesh, run)
    smooth = _smooth(track, wheel, middle)
    source = f"CalculiX {run.version}"
    checks = (
        Check("vertical contact force", 1e-3 * LOAD, 1e-3 * run.press.force, "kN", source, 1e-3),
        *compared("flat faces", flat, theirs, source, (1e-3, 0.02, 0.01)),
        pressures_apart(flat, theirs, source),
        *compared("smooth profiles", smooth, theirs, source, (smooth_band, None, None)),
        Check(
            "peak mean pressure of a face, smooth profiles, against Hertz's p0",
            1e-6 * float(smooth.face_pressure.max()),
            1e-6 * model.hertz.peak_pressure,
            "MPa",
            "Hertz",
            None,
        ),
        Check(
            "area, smooth profiles, against Hertz's",
            1e6 * smooth.area,
            1e6 * model.hertz.area,
            "mm^2",
            "Hertz",
            None,
        ),
    )
    h = model.cell.size
    crown = rail_profile(model.cell.profile).crown_radius
    return CaseResult(
        name=name,
        title=f"Static press on the mesh of {1e3 * h:g} mm against CalculiX",
        method=METHOD.format(
            length=model.length,
            size=1e3 * h,
            load=1e-3 * LOAD,
            nodes=len(mesh.nodes),
            model="the condensed bodies" if model.reduced else "the rail with every node kept",
            sagitta=1e6 * h**2 / 8 * (1 / model.wheel.dimensions.radius + 1 / crown),
        ),
        checks=checks,
        tables=(_pressures(wheel, flat, smooth, theirs, source),),
    )


def compared(
    how: str,
    ours: FacetPress,
    theirs: FacetPress,
    source: str,
    bands: tuple[float | None, float | None, float | None],
) -> tuple[Check, Check, Check]:
    """Approach, area and peak pressure of two presses, with their bands."""
    peak, reference = float(ours.face_pressure.max()), float(theirs.face_pressure.max())
    return (
        Check(
            f"approach, {how}", 1e6 * ours.approach, 1e6 * theirs.approach, "um", source, bands[0]
        ),
        Check(f"contact area, {how}", 1e6 * ours.area, 1e6 * theirs.area, "mm^2", source, bands[1]),
        Check(
            f"peak mean pressure of a face, {how}",
            1e-6 * peak,
            1e-6 * reference,
            "MPa",
            source,
            bands[2],
        ),
    )


def pressures_apart(ours: FacetPress, theirs: FacetPress, source: str) -> Check:
    """Root mean square of the difference of the faces' pressures, relative to theirs."""
    apart = np.linalg.norm(ours.face_pressure - theirs.face_pressure)
    return Check(
        "difference of the pressures, flat faces",
        float(apart / np.linalg.norm(theirs.face_pressure)),
        0.03,
        "",
        source,
        0.0,
        sense="at_most",
    )


def read_as_facets(mesh: PressMesh, run: CalculixRun) -> FacetPress:
    """CalculiX's press as one of ours, its mean pressures on the grid of the tread's faces."""
    corners, press = mesh.corners(mesh.tread), run.press
    # area of a plane quadrilateral from its diagonals, of both halves of a half model
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    area = np.linalg.norm(np.cross(*diagonals), axis=1) * (1.0 if mesh.symmetric else 0.5)
    mx, my = mesh.tread_nodes.shape
    pressure = np.zeros((mx - 1, my - 1))
    pressure[mesh.places(mesh.tread)] = press.face_pressure(mesh.tread[:, 0], area)
    return FacetPress(press.approach, press.area, pressure, press.lateral_force)


def _smooth(track: SolidTrack | UnreducedTrack, wheel: WheelFlexibility, x: float) -> FacetPress:
    """The program's own press."""
    points = wheel_points(wheel)
    curve = geometry_press(track, wheel, np.array([LOAD]), PENALTY, x)
    solution = curve.solutions[0]
    nx, ny = len(wheel.x) - 1, len(wheel.y) - 1
    force, area = (
        values.reshape(nx, 2, ny, 2).sum(axis=(1, 3)) for values in (solution.forces, points.area)
    )
    # not the curve's approach: that is measured to the rail's centre line
    patch = contact_area(points, curve.gaps[0], solution.forces)
    return FacetPress(solution.approach, patch, force / area)


def _pressures(
    wheel: WheelFlexibility, flat: FacetPress, smooth: FacetPress, theirs: FacetPress, source: str
) -> Table:
    """Faces beside the plane of symmetry, outwards from the middle."""
    first = len(wheel.x) // 2
    centre = 0.5 * (wheel.x[1:] + wheel.x[:-1])
    columns = (theirs, flat, smooth)
    rows = tuple(
        (1e3 * float(centre[i]), *(1e-6 * float(p.face_pressure[i, 0]) for p in columns))
        for i in range(first, len(centre))
    )
    header = ("x of the face (mm)", f"{source} (MPa)", "flat faces (MPa)", "smooth (MPa)")
    return Table("Mean pressure of the faces next to the plane of symmetry", header, rows)
