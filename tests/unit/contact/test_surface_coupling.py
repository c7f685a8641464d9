"""The travelling patch against a brute-force solution of the whole coupled system."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.interpolate import make_interp_spline
from scipy.optimize import nnls

from contactstudy.contact.augmented import Penalty
from contactstudy.contact.moving_wheel import MovingWheel
from contactstudy.contact.surface_coupling import SurfaceCoupling
from contactstudy.contact.wheel_path import WheelPath
from contactstudy.dynamics.banded import Factor
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.facets import tread_candidates
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe
from contactstudy.track.stretch import RailStretch
from contactstudy.verification.cases.point_loads import boussinesq

BODIES = Geometry(rail_curve("60E1"), wheel_curve("cylinder"), 0.43)
STEP, N_TRACK, PENALTY = 2e-3, 9, 1e16


def half_space(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Flexibility of a grid of nodes with images about y = 0, blunt at the load."""
    X, Y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    F = np.zeros((len(X), len(X)))
    for image in (1, -1):
        d = np.hypot(X[:, None] - X, Y[:, None] - image * Y)
        zero = np.zeros_like(d)
        F += 0.5 * boussinesq(np.maximum(d, 0.4 * STEP), zero, zero, 210e9, 0.3)[..., 2]
    return F


def rail_matrix(x: np.ndarray, y: np.ndarray, at_x: np.ndarray, at_y: np.ndarray) -> np.ndarray:
    """Cubic splines through the nodes of a surface that is its own image about y = 0."""
    image = np.abs(np.arange(1 - len(y), len(y)))
    whole = np.copysign(y[image], np.arange(1 - len(y), len(y)))
    across = make_interp_spline(whole, np.eye(len(y))[image])(at_y)
    return np.kron(make_interp_spline(x, np.eye(len(x)))(at_x), across)


class FakeTrack:
    """A track of a few dofs that all move the surface, and a half-space on top."""

    thickness, residual_period = STEP, None

    def __init__(self, rng: np.random.Generator) -> None:
        self.shapes = rng.standard_normal((N_TRACK, 2)) * np.array([1.0, 3.0])

    def stretch(self, x: float, half_length: float) -> RailStretch:
        first = int(np.floor((x - half_length) / STEP))
        nodes_x = STEP * np.arange(first, first + int(np.ceil(2 * half_length / STEP)) + 2)
        nodes_y = STEP * np.arange(6)
        X, _ = np.meshgrid(nodes_x, nodes_y, indexing="ij")
        return RailStretch(
            key=first // 50,
            dofs=np.arange(N_TRACK),
            map=1 + 0.1 * np.sin(X.reshape(-1, 1) * self.shapes[:, 0] + self.shapes[:, 1]),
            residual=half_space(nodes_x, nodes_y),
            local=None,
            x=nodes_x,
            y=nodes_y,
            arc=BODIES.rail.arc_of_y(nodes_y),
            centre_dofs=np.arange(N_TRACK),
            centre_map=np.ones((1, N_TRACK)),
            centre_residual=np.zeros((1, X.size)),
        )


def setting(seed: int = 0, n_steps: int = 6):  # type: ignore[no-untyped-def]
    rng = np.random.default_rng(seed)
    track = FakeTrack(rng)
    x, y = STEP * np.arange(-6, 7), STEP * np.arange(5)
    points = contact_points(BODIES, x, y, symmetric=True)
    search = tread_candidates(BODIES, x, y)
    positions = 0.1 + 4.17e-3 * np.arange(n_steps)
    roughness = 1e-6 * np.cos(300 * (positions[:, None] + points.x))
    wheel_F = half_space(x, y)
    none = np.zeros((0, 2)), np.zeros((0, 4), dtype=int), np.zeros((0, 2, len(wheel_F)))
    wheel = MovingWheel(
        points, WheelFlexibility(WheelRecipe(), x, y, wheel_F, *none), np.array([N_TRACK])
    )
    path = WheelPath(positions, roughness)
    coupling = SurfaceCoupling(track, wheel, path, search, Penalty(PENALTY))
    G = rng.standard_normal((N_TRACK + 1, N_TRACK + 1))
    S = G @ G.T * 1e9 + np.diag(np.full(N_TRACK + 1, 2e10))
    S[-1, :-1] = S[:-1, -1] = 0.0
    return track, points, wheel_F, coupling, S, positions, roughness, rng


@pytest.mark.parametrize("scale", [1.0, 0.6])
def test_equals_brute_force(scale: float) -> None:
    track, points, wheel_F, coupling, S, positions, roughness, rng = setting()
    contact, state = coupling.attached(Factor(sp.csr_array(S)), scale), coupling.start()
    Pw = points.wheel_rows.matrix(len(wheel_F))
    for step, X in enumerate(positions):
        u_free = 5e-6 * rng.standard_normal(N_TRACK + 1)
        u_free[-1] -= 80e-6 + 10e-6 * step
        result = contact(step, u_free, state)
        state = result.state
        # B u, all points, dense; the stretch is asked for a wider zone
        stretch = track.stretch(X, 0.02)
        P = rail_matrix(stretch.x, stretch.y, points.x + X, points.y)
        B = np.c_[-P @ stretch.map, points.normal_z]
        W = B @ np.linalg.solve(S, B.T) * scale
        W += P @ stretch.residual @ P.T + Pw @ wheel_F @ Pw.T
        W += np.diag(1 / (PENALTY * points.area))
        r = np.repeat(roughness[step], len(points.y))
        gap = points.gap + B @ u_free - points.normal_z * r
        L = np.linalg.cholesky(0.5 * (W + W.T))
        forces, _ = nnls(L.T, -np.linalg.solve(L, gap), maxiter=10000)
        # the spline of another stretch differs a little at its ends
        total = points.normal_z @ forces
        assert result.record["contact_force"][0] == pytest.approx(total, rel=2e-5)
        np.testing.assert_allclose(result.load, B.T @ forces, atol=1e-4 * total)
        np.testing.assert_allclose(
            result.increment, scale * np.linalg.solve(S, result.load), rtol=1e-9, atol=1e-18
        )
        assert result.record["contact_area"] > 0
        assert np.all(state.forces >= 0)


def test_history_of_the_coupling_does_not_matter() -> None:
    *_, first, S, positions, _, rng = setting()
    *_, second, _, _, _, _ = setting()
    factor = Factor(sp.csr_array(S))
    used, state = first.attached(factor, 1.0), first.start()
    u = 1e-6 * rng.standard_normal(N_TRACK + 1)
    u[-1] -= 90e-6
    for step in range(len(positions) - 1):
        state = used(step, u * rng.uniform(0.5, 1.5), state).state
    last = len(positions) - 1
    a, b = used(last, u, state), second.attached(factor, 1.0)(last, u, second.start())
    np.testing.assert_allclose(a.load, b.load, rtol=1e-9, atol=1e-6)
    # asked again, from the same state, it answers the same bit for bit
    again = used(last, u, state)
    np.testing.assert_array_equal(again.load, a.load)
    np.testing.assert_array_equal(again.state.gap, a.state.gap)


def test_separation_and_return() -> None:
    *_, coupling, S, _, _, _ = setting()
    contact = coupling.attached(Factor(sp.csr_array(S)), 1.0)
    down, up = np.zeros(N_TRACK + 1), np.zeros(N_TRACK + 1)
    down[-1], up[-1] = -80e-6, 1e-3
    touching = contact(0, down, coupling.start())
    before = touching.record["contact_force"][0]
    away = contact(1, up, touching.state)
    assert away.record["contact_force"][0] == 0.0
    assert not away.load.any()
    again = contact(2, down, away.state)
    assert again.record["contact_force"][0] == pytest.approx(before, rel=0.05)


def test_patch_that_leaves_the_fine_zone_is_an_error() -> None:
    *_, coupling, S, _, _, _ = setting()
    contact = coupling.attached(Factor(sp.csr_array(S)), 1.0)
    u = np.zeros(N_TRACK + 1)
    u[-1] = -1e-3
    with pytest.raises(
        NumericalError,
        match=r"edge of the finely meshed zone across .* at step 0, .*contact_half_width",
    ):
        contact(0, u, coupling.start())
