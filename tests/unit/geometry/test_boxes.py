"""Candidates of arbitrary triangulated bodies in arbitrary poses contain the contact set."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from contactstudy.exceptions import InputError
from contactstudy.geometry.boxes import facet_boxes
from contactstudy.geometry.search import CandidateList, FacetSearch, grid_mesh
from contactstudy.geometry.touch import first_touch


def scanned(rng, n, height, half, noise, up):
    """Irregular triangulation of a noisy surface, as a scanner or a decimation makes it."""
    corners = half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    plan = np.concatenate([rng.uniform(-1, 1, (n, 2)) * half, corners])
    faces = Delaunay(plan).simplices.astype(np.int64)
    z = height(plan[:, 0], plan[:, 1]) + noise * rng.standard_normal(len(plan))
    mesh = trimesh.Trimesh(np.column_stack([plan, z]), faces, process=False)
    turned = (mesh.face_normals[:, 2] > 0) != up
    faces[turned] = faces[turned][:, ::-1]
    return trimesh.Trimesh(mesh.vertices, rng.permutation(faces), process=False)


def regular(n, height, half):
    x, y = np.linspace(-half[0], half[0], n), np.linspace(-half[1], half[1], n)
    x, y = np.meshgrid(x, y, indexing="ij")
    return grid_mesh(np.stack([x, y, height(x, y)], axis=-1))


def clearance_at(lower, points):
    """Height of points over a surface, triangle by triangle (inf beside it): the plain twin."""
    found = np.full(len(points), np.inf)
    for a, b, c in np.asarray(lower.triangles):
        edges = np.column_stack([b[:2] - a[:2], c[:2] - a[:2]])
        if abs(np.linalg.det(edges)) < 1e-18:
            continue
        u = np.linalg.solve(edges, (points[:, :2] - a[:2]).T)
        inside = (u >= 0).all(axis=0) & (u.sum(axis=0) <= 1)
        z = a[2] + u[0] * (b[2] - a[2]) + u[1] * (c[2] - a[2])
        found = np.where(inside, np.minimum(found, points[:, 2] - z), found)
    return found


def probed(upper):
    """Corners, centres and inner points of every facet, and the facet of each."""
    weights = np.array(
        [[1, 0, 0], [0, 1, 0], [0, 0, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4], [2, 2, 2]]
    )
    weights = weights / weights.sum(axis=1, keepdims=True)
    points = np.einsum("pc,tcd->tpd", weights, np.asarray(upper.triangles)).reshape(-1, 3)
    return points, np.repeat(np.arange(len(upper.faces)), len(weights))


SHAPES = {
    "scan": lambda rng, n, f, half, noise, up: scanned(rng, n, f, half, noise, up),
    "grid": lambda rng, n, f, half, noise, up: regular(int(np.sqrt(n)) + 2, f, half),
}


@given(
    seed=st.integers(0, 10**6),
    lower=st.sampled_from(sorted(SHAPES)),
    upper=st.sampled_from(sorted(SHAPES)),
    crown=st.sampled_from([0.3, 0.08, 0.013]),
    noise=st.sampled_from([0.0, 2e-6, 1e-4, 1e-3]),
    shift=st.tuples(st.floats(-0.01, 0.01), st.floats(-0.02, 0.02)),
    roll=st.floats(-0.1, 0.1),
    yaw=st.floats(-0.03, 0.03),
    penetration=st.floats(1e-7, 1e-3),
)
@settings(max_examples=30)
def test_candidates_contain_all_that_penetrates(
    seed, lower, upper, crown, noise, shift, roll, yaw, penetration
):
    rng = np.random.default_rng(seed)
    half = np.array([0.03, 0.02])
    side = crown * np.sin(1.2)

    def rail(x, y):  # an arc that goes on as a slope where it is steep
        b = np.minimum(np.abs(y), side)
        fall = b**2 / (crown + np.sqrt(crown**2 - b**2))
        return 0 * x - fall - 2.57 * (np.abs(y) - b)

    low = SHAPES[lower](rng, 60, rail, half, noise, True)
    up = SHAPES[upper](rng, 60, lambda x, y: x**2 / 0.92 + 0.05 * y, half, noise, False)
    up.apply_transform(trimesh.transformations.euler_matrix(roll, 0.0, yaw))
    up.apply_translation([*shift, 0.05])
    touch = first_touch(low, up)
    up.apply_translation([0.0, 0.0, -touch.travel])
    points, facet = probed(up)
    clearance = clearance_at(low, points)
    assert clearance.min() >= -1e-9  # none below the surface at first touch
    candidates = CandidateList(FacetSearch(up), low)
    for approach in (penetration, 0.5 * penetration, penetration + 15e-6):
        found = candidates.facets(approach)
        inside = np.unique(facet[clearance < approach])
        assert np.all(np.isin(inside, found))


def test_first_touch_is_the_least_clearance():
    rng = np.random.default_rng(3)
    for noise in (0.0, 2e-6, 5e-4):
        low = scanned(rng, 100, lambda x, y: -(y**2) / 0.6, np.array([0.03, 0.02]), noise, True)
        up = scanned(rng, 100, lambda x, y: x**2 / 0.9, np.array([0.02, 0.02]), noise, False)
        up.apply_transform(trimesh.transformations.euler_matrix(0.02, 0.0, 0.01))
        up.apply_translation([0.002, 0.003, 0.2])
        touch = first_touch(low, up)
        points, _ = probed(up)
        # every clearance is at least the first touch's, and it is reached at the point found
        assert clearance_at(low, points).min() >= touch.travel - 1e-12
        assert clearance_at(low, touch.point[None] + 1e-12)[0] == pytest.approx(0.0, abs=1e-9)
        normal = up.face_normals[touch.upper_facet]
        corner = up.triangles[touch.upper_facet][0] - touch.point
        assert corner @ normal / normal[2] == pytest.approx(touch.travel, abs=1e-9)


def test_boxes_enclose_every_facet():
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=0.05)
    boxes = facet_boxes(sphere, 0.01, 1e-6, along=0.02)
    low, high = sphere.triangles.min(axis=1), sphere.triangles.max(axis=1)
    inside = np.all(low[:, None] >= boxes[:, 0], axis=2) & np.all(
        high[:, None] <= boxes[:, 1], axis=2
    )
    assert np.all(inside.any(axis=1))
    assert 50 < len(boxes) < len(sphere.faces)
    # without a size along x a box may be as long as the body
    assert len(facet_boxes(sphere, 0.01)) < len(boxes)


def test_impossible_boxes_are_refused():
    sphere = trimesh.creation.icosphere(subdivisions=1, radius=0.05)
    with pytest.raises(InputError, match="sizes above 0 m"):
        facet_boxes(sphere, 0.0)
