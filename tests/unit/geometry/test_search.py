"""Candidates must contain every facet in contact; first touch must be exact."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.contact.complementarity import contact_forces
from contactstudy.exceptions import InputError
from contactstudy.geometry.facets import tread_candidates
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints, contact_points
from contactstudy.geometry.search import CandidateList, FacetSearch
from contactstudy.geometry.touch import first_touch
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.point_loads import boussinesq

BODIES = Geometry(rail_curve("60E1"), wheel_curve("cylinder"), 0.43)


def surfaces(size: float) -> tuple[ContactPoints, CandidateList]:
    n, m = round(12e-3 / size), round(8e-3 / size)
    x, y = np.arange(-n, n + 1) * size, np.arange(m + 1) * size
    return contact_points(BODIES, x, y, symmetric=True), tread_candidates(BODIES, x, y)


def flexibility(points: ContactPoints) -> np.ndarray:
    """Two half-spaces, loads spread over the points' own areas (closed form)."""
    x, y = points.x_of_points, points.y_of_points
    W = np.zeros((len(x), len(x)))
    radius = np.sqrt(points.area / np.pi)
    for image in (1, -1):
        dx, dy = x[:, None] - x[None], y[:, None] - image * y[None]
        distance = np.maximum(np.hypot(dx, dy), 0.5 * radius[None])
        zero = np.zeros_like(distance)
        W += boussinesq(distance, zero, zero, 210e9, 0.3)[..., 2]
    return W + np.diag(1e-10 * np.ones(len(x)))


CASES = {size: surfaces(size) for size in (2e-3, 4e-3)}
FLEXIBILITY = {size: flexibility(points) for size, (points, _) in CASES.items()}


@given(
    st.sampled_from(sorted(CASES)),
    st.floats(-50e-6, 200e-6),
    st.integers(0, 10**6),
    st.floats(0.0, 30e-6),
)
@settings(max_examples=60)
def test_candidates_contain_the_contact_set(
    size: float, approach: float, seed: int, roughness: float
) -> None:
    points, candidates = CASES[size]
    rng = np.random.default_rng(seed)
    rough = roughness * np.cos(rng.uniform(20, 2000) * points.x_of_points + rng.uniform(0, 6.3))
    free = points.gap - (approach + rough) * points.normal_z
    facets = candidates.quads(float(np.max(approach + rough)))
    overlapping = np.unique(points.facet[free < 0])
    assert np.all(np.isin(overlapping, facets))
    W = FLEXIBILITY[size]
    M = W + np.diag(1 / (1e16 * points.area))
    active = contact_forces(0.5 * (M + M.T), free).active
    assert np.all(np.isin(points.facet[active], facets))


def test_candidates_are_few_and_seldom_searched() -> None:
    points, candidates = surfaces(2e-3)
    n_facets = (len(points.wheel_x) - 1) * (len(points.wheel_y) - 1)
    rng = np.random.default_rng(0)
    for approach in 70e-6 + 10e-6 * rng.random(500):
        found = candidates.quads(approach)
    assert candidates.queries <= 2
    assert 0 < len(found) < n_facets
    assert len(candidates.quads(0.0)) < n_facets / 2
    assert len(candidates.quads(-1e-3)) == 0


def test_every_facet_in_a_box_is_found() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=0.1)
    search = FacetSearch(mesh)
    low, high = np.array([0.02, -0.03, 0.05]), np.array([0.09, 0.04, 0.12])
    found = search.meeting(np.array([[low, high]]))
    inside = np.all((mesh.triangles_center > low) & (mesh.triangles_center < high), axis=1)
    assert np.all(np.isin(np.flatnonzero(inside), found))
    assert len(found) < len(mesh.faces) / 2
    moved = search.meeting(np.array([[low, high]]) + 1.0, np.ones(3))
    np.testing.assert_array_equal(moved, found)


def test_surface_without_facets_is_refused() -> None:
    with pytest.raises(InputError, match="no facets"):
        FacetSearch(trimesh.Trimesh(np.zeros((3, 3)), np.empty((0, 3), dtype=int), process=False))


@given(st.floats(-0.02, 0.02), st.floats(-0.02, 0.02), st.floats(-1.0, 1.0))
@settings(max_examples=15)
def test_first_touch_of_facetted_spheres(dx: float, dy: float, lift: float) -> None:
    lower = trimesh.creation.icosphere(subdivisions=3, radius=0.3)
    upper = trimesh.creation.icosphere(subdivisions=3, radius=0.2)
    upper.apply_translation([dx, dy, 1.0 + lift])
    touch = first_touch(lower, upper)
    # facets lie inside the spheres: the clearance is that of the spheres or a little more
    exact = 1.0 + lift - np.sqrt(0.5**2 - dx**2 - dy**2)
    sagitta = 0.3 * 0.0075 + 0.2 * 0.0075
    assert exact - 1e-12 <= touch.travel <= exact + sagitta
    # brute force: least clearance of all vertices and a fine grid by vertical rays
    grid = touch.point[:2] + 5e-3 * np.stack(np.meshgrid(*2 * [np.linspace(-1, 1, 41)]), -1)
    assert touch.travel <= _clearance(lower, upper, grid.reshape(-1, 2)) + 1e-9


def _clearance(lower: trimesh.Trimesh, upper: trimesh.Trimesh, at: np.ndarray) -> float:
    def heights(mesh: trimesh.Trimesh, sign: int) -> np.ndarray:
        T = mesh.triangles[mesh.face_normals[:, 2] * sign > 0.5]
        a, b, c = T[:, 0], T[:, 1], T[:, 2]
        n = np.cross(b - a, c - a)
        z = a[:, 2] - (n[:, :2] * (at[:, None] - a[None, :, :2])).sum(-1) / n[:, 2]
        # a convex body: its surface is the inner envelope of its facets' planes
        return z.min(axis=1) if sign > 0 else z.max(axis=1)

    return float((heights(upper, -1) - heights(lower, 1)).min())


def test_bodies_that_never_touch() -> None:
    lower = trimesh.creation.box((0.1, 0.1, 0.1))
    upper = trimesh.creation.box((0.1, 0.1, 0.1))
    upper.apply_translation([0.5, 0.0, 1.0])
    with pytest.raises(InputError, match="never touch"):
        first_touch(lower, upper)
