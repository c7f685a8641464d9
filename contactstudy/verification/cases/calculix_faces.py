"""A static press as CalculiX and as the program have it, by the faces of the tread."""

from collections.abc import Mapping

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.groups import contact_area
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.export.press_mesh import PressMesh
from contactstudy.geometry.placement import Geometry
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.track.meshed import MeshedTrack
from contactstudy.verification.cases.calculix_results import CalculixPress
from contactstudy.verification.cases.flat_press import FacetPress
from contactstudy.verification.check import (
    Check,
    ResultTable,
    check_at_most,
    check_shown,
)

PEAK = "peak mean pressure of a face"


def smooth_press(track: MeshedTrack, contact: SurfaceContact, load: float, x: float) -> FacetPress:
    """The program's own press between smooth profiles; arguments as of `flat_press`."""
    wheel = contact.wheel
    geometry = contact.geometry or Geometry.of(wheel.recipe)
    points, curve = contact.points, geometry_press(track, contact, np.array([load]), x)
    solution = curve.solutions[0]
    shape = len(wheel.x) - 1, 2, len(wheel.y) - 1, 2
    force, area = (
        values.reshape(shape).sum(axis=(1, 3)) for values in (solution.forces, points.area)
    )
    sideways = 0.0  # of two halves together
    if not wheel.recipe.symmetric:
        normal = geometry.pose.track_of_rail(geometry.rail.normal(points.arc))
        sideways = float(solution.forces.reshape(len(points.x), -1).sum(axis=0) @ normal[:, 0])
    # not the curve's approach: that is measured to the rail's centre line
    patch = contact_area(points, curve.gaps[0], solution.forces)
    return FacetPress(solution.approach, patch, force / area, sideways)


def press_checks(
    how: str,
    ours: FacetPress,
    theirs: FacetPress,
    source: str,
    bands: tuple[float | None, float | None, float | None],
) -> tuple[Check, Check, Check]:
    """Approach, area and peak pressure of two presses, with their bands."""
    peak, reference = float(ours.face_pressure.max()), float(theirs.face_pressure.max())
    return (
        check_shown(f"approach, {how}", ours.approach, theirs.approach, "µm", source, bands[0]),
        check_shown(f"contact area, {how}", ours.area, theirs.area, "mm²", source, bands[1]),
        check_shown(f"{PEAK}, {how}", peak, reference, "MPa", source, bands[2]),
    )


def pressures_apart(ours: FacetPress, theirs: FacetPress, source: str) -> Check:
    """Root mean square of the difference of the faces' pressures, relative to theirs."""
    apart = np.linalg.norm(ours.face_pressure - theirs.face_pressure)
    share = float(apart / np.linalg.norm(theirs.face_pressure))
    return check_at_most("difference of the pressures, flat faces", share, 0.03, "", source)


def read_as_facets(mesh: PressMesh, press: CalculixPress) -> FacetPress:
    """CalculiX's press as one of ours, its mean pressures on the grid of the tread's faces."""
    corners = mesh.corners(mesh.tread)
    # area of a plane quadrilateral from its diagonals, of both halves of a half model
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    area = np.linalg.norm(np.cross(*diagonals), axis=1) * (1.0 if mesh.symmetric else 0.5)
    mx, my = mesh.tread_nodes.shape
    pressure = np.zeros((mx - 1, my - 1))
    pressure[mesh.places(mesh.tread)] = press.face_pressure(mesh.tread[:, 0], area)
    return FacetPress(press.approach, press.area, pressure, press.lateral_force)


def pressure_table(
    caption: str, place: str, at: Array, presses: Mapping[str, Array]
) -> ResultTable:
    """Mean pressures (k,) in Pa of faces `at` (k,) in m, whose column is called `place`."""
    rows = tuple(
        (1e3 * float(x), *(1e-6 * float(pressure[i]) for pressure in presses.values()))
        for i, x in enumerate(at)
    )
    return ResultTable(caption, (place, *(f"{name} (MPa)" for name in presses)), rows)
