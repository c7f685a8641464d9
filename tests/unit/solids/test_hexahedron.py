"""Element kernels against scikit-fem, the patch test and closed forms."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.solids.hexahedron import hex_mass, hex_stiffness

E, NU, RHO = 210e9, 0.3, 7850.0
UNIT = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float
)


def distorted(seed=0, scale=0.1):
    return UNIT + scale * np.random.default_rng(seed).uniform(-1, 1, UNIT.shape)


def test_plain_element_equals_scikit_fem():
    fem = pytest.importorskip("skfem")
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    corners = distorted()
    # scikit-fem numbers the corners its own way: find the mesh's order by position
    mesh = fem.MeshHex()
    order = [int(np.argmin(np.abs(mesh.p.T - c).sum(1))) for c in UNIT]
    p = mesh.p.copy()
    p[:, order] = corners.T
    basis = fem.Basis(
        fem.MeshHex(p, mesh.t),
        fem.ElementVector(fem.ElementHex1()),
        quadrature=_gauss8(),
    )
    K = linear_elasticity(*lame_parameters(E, NU)).assemble(basis).toarray()
    dofs = basis.nodal_dofs[:, order].T.ravel()
    np.testing.assert_allclose(
        hex_stiffness(corners[None], E, NU, incompatible=False)[0],
        K[np.ix_(dofs, dofs)],
        rtol=1e-10,
        atol=1e-3,
    )


def _gauss8():
    g = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3)
    X = np.stack(np.meshgrid(g, g, g, indexing="ij")).reshape(3, -1)
    return X, np.full(8, 1 / 8)


@pytest.mark.parametrize("incompatible", [False, True])
def test_six_rigid_motions_and_no_more(incompatible):
    K = hex_stiffness(distorted()[None], E, NU, incompatible)[0]
    values = np.linalg.eigvalsh(K)
    assert np.sum(np.abs(values) < 1e-9 * values[-1]) == 6
    assert values[0] > -1e-9 * values[-1]


@pytest.mark.parametrize("incompatible", [False, True])
def test_patch_constant_strain(incompatible):
    """A distorted 2x2x2 patch under linear boundary displacements is linear inside."""
    g = np.linspace(0, 1, 3)
    nodes = np.stack(np.meshgrid(g, g, g, indexing="ij"), -1).reshape(-1, 3)
    inner = 13
    nodes[inner] += [0.11, -0.07, 0.09]
    idx = np.arange(27).reshape(3, 3, 3)
    a = (slice(0, 2), slice(1, 3))
    corner = [
        (0, 0, 0),
        (1, 0, 0),
        (1, 1, 0),
        (0, 1, 0),
        (0, 0, 1),
        (1, 0, 1),
        (1, 1, 1),
        (0, 1, 1),
    ]
    elements = np.stack([idx[a[i], a[j], a[k]].ravel() for i, j, k in corner], 1)
    Ke = hex_stiffness(nodes[elements], E, NU, incompatible)
    K = np.zeros((81, 81))
    for conn, k in zip(elements, Ke, strict=True):
        d = (3 * conn[:, None] + np.arange(3)).ravel()
        K[np.ix_(d, d)] += k
    F = np.random.default_rng(1).uniform(-1, 1, (3, 3)) * 1e-3
    u = nodes @ F.T
    free = 3 * inner + np.arange(3)
    fixed = np.setdiff1d(np.arange(81), free)
    solved = np.linalg.solve(K[np.ix_(free, free)], -K[np.ix_(free, fixed)] @ u.ravel()[fixed])
    np.testing.assert_allclose(solved, u[inner], rtol=1e-9)


def test_incompatible_modes_bend_exactly():
    """One element through the depth under pure bending: curvature M/EI for nu = 0."""
    length, b, h, n = 1.0, 0.05, 0.1, 4
    x = np.linspace(0, length, n + 1)
    coords = UNIT[None] * [length / n, b, h] + np.stack([x[:-1], 0 * x[1:], 0 * x[1:]], 1)[:, None]
    for incompatible, expected in ((True, 1.0), (False, None)):
        K = np.zeros((12 * (n + 1), 12 * (n + 1)))
        for e, k in enumerate(hex_stiffness(coords, E, 0.0, incompatible)):
            left = [0, 3, 4, 7]
            conn = [4 * (e + (a not in left)) + [0, 0, 1, 1, 2, 2, 3, 3][_pos(a)] for a in range(8)]
            d = (3 * np.array(conn)[:, None] + np.arange(3)).ravel()
            K[np.ix_(d, d)] += k
        f = np.zeros(12 * (n + 1))
        z = np.array([0, 0, h, h]) - h / 2  # plane nodes: (y0,z0) (y1,z0) (y0,z1) (y1,z1)
        f[12 * n + 3 * np.arange(4)] = z / h  # moment 2 * (1/2 * h/2 * 2) = h/h * h
        moment = np.sum(z / h * z)
        u = np.zeros_like(f)
        free = np.arange(12, len(f))
        u[free] = np.linalg.solve(K[np.ix_(free, free)], f[free])
        tip = u[12 * n + 2 :: 3][:4].mean()
        ratio = -tip / (moment * length**2 / (2 * E * b * h**3 / 12))
        if expected is not None:
            assert ratio == pytest.approx(1.0, rel=1e-9)
        else:
            assert ratio < 0.9  # the plain element locks


def _pos(a):
    # position of an element corner within its plane, in the order used above
    return {0: 0, 1: 0, 3: 2, 2: 2, 4: 4, 5: 4, 7: 6, 6: 6}[a]


def test_mass_totals():
    coords = distorted(3)[None]
    M = hex_mass(coords, RHO)[0]
    ex = np.tile([1.0, 0, 0], 8)
    fine = 40
    # volume by subdivision of the trilinear map
    g = (np.arange(fine) + 0.5) / fine * 2 - 1
    from contactstudy.solids.hexahedron import _jacobians, _shape

    pts = np.stack(np.meshgrid(g, g, g, indexing="ij"), -1).reshape(-1, 3)
    _, det = _jacobians(coords, _shape(pts)[1])
    assert ex @ M @ ex == pytest.approx(RHO * det.sum() * (2 / fine) ** 3, rel=1e-4)
    assert abs(ex @ M @ np.tile([0, 1.0, 0], 8)) < 1e-9


def test_bad_element_and_material():
    flipped = UNIT[[4, 5, 6, 7, 0, 1, 2, 3]][None]
    with pytest.raises(InputError, match="inverted"):
        hex_stiffness(flipped, E, NU)
    with pytest.raises(InputError, match=r"youngs_modulus.*\n.*poisson"):
        hex_stiffness(UNIT[None], -1.0, 0.5)
