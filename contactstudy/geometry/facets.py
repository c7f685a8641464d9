"""Triangulated surfaces of rails and wheels from their profiles, and the search between them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.geometry.boxes import largest_sagitta
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.search import CandidateList, FacetSearch, grid_mesh
from contactstudy.profiles.curve import ProfileCurve

if TYPE_CHECKING:
    import trimesh


def rail_surface(rail: ProfileCurve, x: ArrayLike, s: ArrayLike) -> trimesh.Trimesh:
    """Running surface of a straight rail, in its own axes, normals out of the rail.

    `x` and `s`, (nx, 1), (1, ny) or (nx, ny), are positions along the rail and arc lengths of the
    nodes ``i*ny + j`` [m].
    """
    x, s = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(s, dtype=float))
    return grid_mesh(np.concatenate([x[..., None], rail.point(s)], axis=-1))


def wheel_surface(
    wheel: ProfileCurve, radius: float, x: ArrayLike, s: ArrayLike
) -> trimesh.Trimesh:
    """Tread of a wheel as a surface of revolution, in its own axes, normals down.

    `radius` is that of the tape circle; `x` and `s`, (nx, 1), (1, ny) or (nx, ny), are positions
    along the wheel and arc lengths of the nodes ``i*ny + j`` [m]; quadrilaterals as in `grid_mesh`.
    """
    x, s = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(s, dtype=float))
    nodes, _ = PlacedWheel(wheel, radius, Pose()).points_and_normals(x.ravel(), s.ravel())
    mesh = grid_mesh(nodes.reshape(*x.shape, 3))
    mesh.invert()
    return mesh


def in_track_axes(mesh: trimesh.Trimesh, pose: Pose, wheel: bool) -> trimesh.Trimesh:
    """Copy of a wheel's or a rail's surface turned from its own axes to those of the track.

    The wheel's tape circle is level with the crown of the rail.
    """
    import trimesh

    v = np.asarray(mesh.vertices, dtype=float)
    if wheel:
        v = v @ pose.to_track.T + np.array([0.0, pose.lateral, 0.0])
    else:
        v = np.column_stack([v[:, 0], pose.track_of_rail(v[:, 1:])])
    return trimesh.Trimesh(v, mesh.faces, process=False)


def tread_candidates(
    geometry: Geometry, wheel_x: Array, wheel_s: Array, padding: float = 20e-6
) -> CandidateList:
    """Search of a wheel's tread facets over the rail, in track axes.

    Arguments as in `contactstudy.geometry.points.contact_points`, whose `facet` are the list's
    `quads`; `padding` in m. Approach 0 is the first touch of the smooth surfaces.
    """
    rail, wheel, pose, radius = geometry.rail, geometry.wheel, geometry.pose, geometry.radius
    wheel_x, wheel_s = np.asarray(wheel_x, dtype=float), np.asarray(wheel_s, dtype=float)
    upper = in_track_axes(
        wheel_surface(wheel, radius, wheel_x[:, None], wheel_s[None, :]), pose, wheel=True
    )
    upper.apply_translation([0.0, 0.0, -geometry.touch.travel])
    # as far as the wheel reaches, turned; finer than the wheel, so that its boxes are tight
    reach = float(np.abs(upper.vertices[:, 0]).max()) + 1e-3
    first, last = rail.s_range
    s = np.linspace(first, last, int(np.ceil((last - first) / 0.5e-3)) + 1)
    lower = in_track_axes(
        rail_surface(rail, np.array([[-reach], [reach]]), s[None, :]), pose, wheel=False
    )
    sagitta = largest_sagitta(rail, s) + largest_sagitta(wheel, wheel_s)
    # the parallels of a wheel: chords along x of circles of radius R - h
    sagitta += float(np.diff(wheel_x).max()) ** 2 / (8.0 * radius) * 1.2
    return CandidateList(FacetSearch(upper), lower, sagitta=sagitta, padding=padding)
