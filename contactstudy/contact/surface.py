"""Surface contact as the time stepper sees it: a travelling patch of contact points.

With the wheel's displacements w (its hub's, up, and those of its elastic modes, if it has any),
which move the point by G w into the wheel, the rail's surface displacement u_n along its normal,
and the irregularity r, the gap at point i is

    g_i = gap_i + (G w)_i - u_n(X + x_i, y_i) - n_i r(X + x_i)

and its flexibility W = Res + scale P_r H S^-1 H^T P_r^T + P_w F_w P_w^T + scale G S_ww^-1 G^T:
H is the map from the track's dofs to its surface nodes, P_r and P_w interpolate nodes to points,
Res is the rail's residual flexibility (`contact.residual`), F_w the wheel's relative to its hub
(without what its modes have of it). G's first column is the normal's vertical component.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.contact.augmented import enforcement
from contactstudy.contact.groups import patch_record
from contactstudy.contact.press import penalty_compliance
from contactstudy.contact.residual import PatchSource, ResidualFlexibility, patch_splines
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.stepper import ContactStep
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.points import ContactPoints
from contactstudy.geometry.search import CandidateList

NEAR = 0.3e-6
"""Points whose gap was below this [m] a step before enter the dense problem from the start."""


@dataclass(frozen=True)
class PatchState:
    """Contact at the end of the last step, at all points.

    Attributes
    ----------
    forces : ndarray (n,)
        Normal forces in N.
    surface_load : ndarray (nodes,)
        Nodal forces on the rail's surface patch, in N, positive into the rail.
    gap : ndarray (n,)
        Gaps in m; minus the penetration where there is a force.
    """

    forces: Array
    surface_load: Array
    gap: Array


class SurfaceCoupling:
    """Pressure on the points of one wheel.

    Parameters
    ----------
    track : PatchSource
        Its dofs are the first ones of the system.
    points : ContactPoints
        Of the wheel.
    wheel_flexibility : ndarray (nodes, nodes)
        Of the wheel's tread nodes relative to the hub, in m/N; without the share of the modes.
    wheel_dof : int
        Dof of the system that is the wheel's (its hub's) displacement.
    positions : ndarray (n_times,)
        X of the wheel at every state in m.
    irregularity : ndarray (n_times, len(points.x))
        r at X + points.x in m.
    candidates : CandidateList
        Facets that can touch.
    penalty : float
        In Pa/m.
    rail_step : float
        Distance of the rail's surface nodes along X in m.
    rail_period : int or None
        Steps after which the rail's residual flexibility repeats; its ripple with the phase of
        the mesh is then taken out, see `contact.residual`.
    tolerance : float or None
        Largest overlap in m that an augmented Lagrangian leaves, which starts from the forces of
        the last step; None: the penalty alone.
    mode_dofs : ndarray of int (m,)
        Dofs of the system that are the wheel's elastic modes.
    mode_shapes : ndarray (m, nodes)
        Their displacement of the tread nodes into the wheel, in m per unit of the dof.

    Attributes
    ----------
    points, positions
        As given.
    wheel_dofs : ndarray of int (1 + m,)
        The hub's dof and the modes'.
    half_length : float
        Of the patches asked of the track in m.
    last : PatchState
        Contact at the end of the last step.
    """

    def __init__(
        self,
        track: PatchSource,
        points: ContactPoints,
        wheel_flexibility: Array,
        wheel_dof: int,
        positions: Array,
        irregularity: Array,
        candidates: CandidateList,
        penalty: float,
        rail_step: float,
        rail_period: int | None = None,
        tolerance: float | None = None,
        mode_dofs: Sequence[int] = (),
        mode_shapes: Array | None = None,
    ) -> None:
        self._track, self.points, self._candidates = track, points, candidates
        self.wheel_dof, self.positions, self._irregularity = wheel_dof, positions, irregularity
        self._compliance = penalty_compliance(points, penalty)
        self._law = enforcement(tolerance)
        n = len(points.gap)
        tread = points.wheel_rows.matrix(len(wheel_flexibility))
        self._wheel_W = tread @ wheel_flexibility @ tread.T
        self._tread, self._tread_area = tread.T, tread.T @ points.area
        self.wheel_dofs = np.array([wheel_dof, *mode_dofs], dtype=np.int64)
        self._wheel_map = points.normal_z[:, None]
        if mode_shapes is not None:
            self._wheel_map = np.column_stack([points.normal_z, tread @ mode_shapes.T])
        # two nodes beyond the outermost point, for the spline
        self.half_length = float(np.abs(points.x).max()) + 2 * rail_step
        self._active = np.zeros(n, dtype=bool)
        self._gap = points.gap
        self._overlap = np.zeros(n)
        self._listed: IntArray | None = None
        self._allowed = np.zeros(n, dtype=bool)
        self._patch_step = -1
        self._rail_step, self._rail_period = rail_step, rail_period
        self._spline: SplineLine | None = None
        self.last = PatchState(np.zeros(n), np.zeros(0), points.gap)

    def attach(self, factor: Factor, scale: float) -> None:
        """Take the factor of the system and the share of the new force in a step."""
        self._factor, self._scale = factor, scale
        unit = np.zeros((factor.n, len(self.wheel_dofs)))
        unit[self.wheel_dofs, np.arange(len(self.wheel_dofs))] = 1.0
        columns = factor.solve(unit)
        self._vehicle = np.flatnonzero(columns.any(axis=1))
        self._vehicle_response = scale * columns[self._vehicle]
        compliance = columns[self.wheel_dofs]
        moving = self._wheel_map @ (0.5 * scale * (compliance + compliance.T)) @ self._wheel_map.T
        # the whole wheel: its inertia and modes, and its flexibility
        self._body_W = self._wheel_W + moving
        self._columns: dict[int, Array] = {}
        self._compliance_key: int | None = None
        self._patch_step = -1

    def __call__(self, step: int, u_free: Array) -> ContactStep:
        """Forces at the end of a step."""
        points, normal = self.points, self.points.normal_z
        self._move_to(step)
        patch = self._patch
        roughness = np.repeat(self._irregularity[step], len(points.y))
        free = (
            points.gap
            + self._wheel_map @ u_free[self.wheel_dofs]
            - roughness * normal
            - self._interpolated(patch.map @ u_free[patch.dofs])
        )
        allowed = self._candidate_points(float(((points.gap - free) / normal).max()))
        forces, surface_load = self._solve(step, free, self._gap < NEAR, allowed)
        load = np.zeros(len(u_free))
        # a dof may be named twice, where an end of the track is held
        modal = patch.map.T @ surface_load
        np.subtract.at(load, patch.dofs, modal)
        total = float(normal @ forces)
        on_wheel = forces @ self._wheel_map
        load[self.wheel_dofs] += on_wheel
        # scale S^-1 load from the columns at hand, which is cheaper than another solution
        increment = np.zeros(len(u_free))
        increment[self._reach] = -self._scale * (modal @ self._response)
        increment[self._vehicle] += self._vehicle_response @ on_wheel
        self.last = PatchState(forces, surface_load, self._gap)
        record: dict[str, Array | float] = {
            "contact_force": np.array([total]),
            "peak_pressure": float((self._tread @ forces / self._tread_area).max()),
            "penetration": float(self._overlap.max()),
            **patch_record(points, self._gap, forces),
            # what the reduced track leaves out of the centre line's deflection
            "centre_residual": -float(patch.centre_residual[0] @ surface_load),
        }
        if len(patch.centre_map) == 3:
            at = patch.centre_dofs
            motion = patch.centre_map[1:] @ (u_free[at] + increment[at])
            motion -= patch.centre_residual[1:] @ surface_load
            record["rail_lateral"], record["rail_roll"] = float(motion[0]), float(motion[1])
        return ContactStep(load, increment, record)

    def _move_to(self, step: int) -> None:
        """Patch and interpolation at a step."""
        if step == self._patch_step:
            return
        X = float(self.positions[step])
        patch = self._track.patch(X, self.half_length)
        if self._spline is None:
            self._spline, self._across = patch_splines(patch, self.points)
            self._residual = ResidualFlexibility(
                self._spline,
                self._across,
                self.points.x,
                self._rail_step,
                self._rail_period,
            )
        self._along = self._spline(X - patch.x[0] + self.points.x)
        if patch.key != self._compliance_key:
            self._dof_compliance = self._compliance_of(patch.dofs)
            self._compliance_key = patch.key
        self._patch, self._patch_step = patch, step
        self._residual_W = self._residual(X, patch)

    def _interpolated(self, nodal: Array) -> Array:
        """Values at the points from values at the rail's surface nodes."""
        grid = nodal.reshape(self._along.shape[1], -1)
        return (self._along @ grid @ self._across.T).ravel()

    def _compliance_of(self, dofs: IntArray) -> Array:
        """S^-1 on the patch's dofs; columns are kept while the wheel passes them."""
        wanted = sorted(set(dofs.tolist()))
        missing = [d for d in wanted if d not in self._columns]
        unit = np.zeros((self._factor.n, len(missing)))
        unit[missing, np.arange(len(missing))] = 1.0
        solved = self._factor.solve(unit)
        self._columns = {d: self._columns[d] for d in wanted if d in self._columns} | {
            d: np.ascontiguousarray(solved[:, k]) for k, d in enumerate(missing)
        }
        columns = np.stack([self._columns[d] for d in dofs.tolist()])
        # in one time step a load is felt a metre or so away: the rest is below rounding
        size = np.abs(columns).max(axis=0)
        felt = np.flatnonzero(size > 1e-18 * size.max())
        self._reach = slice(int(felt[0]), int(felt[-1]) + 1)
        self._response = np.ascontiguousarray(columns[:, self._reach])
        C = columns[:, dofs]
        return np.asarray(0.5 * (C + C.T))

    def _candidate_points(self, approach: float) -> BoolArray:
        listed = self._candidates.quads(approach)
        if listed is not self._listed:
            self._allowed = self.points.listed(listed)
            self._listed = listed
        return self._allowed

    def _solve(
        self, step: int, free: Array, chosen: BoolArray, allowed: BoolArray
    ) -> tuple[Array, Array]:
        """Forces at all points and nodal forces on the rail's surface.

        The dense problem holds the chosen points only. Its solution is checked at all points;
        those found overlapping join, so the restriction never changes the result.
        """
        n, patch = len(free), self._patch
        C = self._residual.beyond(self._scale * self._dof_compliance, patch)
        H = patch.map
        ny = len(self.points.y)
        for _ in range(20):
            index = np.flatnonzero(chosen)
            forces, active, overlap = np.zeros(n), np.zeros(n, dtype=bool), np.zeros(n)
            nodal = np.zeros(len(H))
            if len(index):
                P = self._along[index // ny, :, None] * self._across[index % ny, None, :]
                P = P.reshape(len(index), -1)
                PH = P @ H
                M = PH @ C @ PH.T
                M += self._residual_W.block(index)
                M += self._body_W[index[:, None], index]
                M.flat[:: len(index) + 1] += self._compliance[index]
                solution, overlap[index] = self._law.forces(
                    M,
                    free[index],
                    self._compliance[index],
                    self.last.forces[index],
                    self._active[index],
                )
                forces[index], active[index] = solution.forces, solution.active
                nodal = P.T @ solution.forces
            loaded = np.flatnonzero(forces)
            pressing = forces[loaded]
            gap = (
                free
                + pressing @ self._body_W[loaded]
                + self._residual_W.product(loaded, pressing)
                + self._interpolated(H @ (C @ (H.T @ nodal)))
            )
            missed = ~chosen & (gap < -1e-12)
            if not missed.any():
                self._check_edge(step, active)
                self._active, self._gap, self._overlap = active, gap, overlap
                return forces, nodal
            if np.any(missed & ~allowed):
                raise NumericalError(
                    f"contact search missed points in contact at step {step}, X = "
                    f"{self.positions[step]:.4f} m: gap {gap[missed & ~allowed].min():.3e} m "
                    "outside the candidate facets"
                )
            chosen = chosen | missed
        raise NumericalError(
            f"contact: the set of points near contact does not settle at step {step}, X = "
            f"{self.positions[step]:.4f} m ({len(index)} of {n} points)"
        )

    def _check_edge(self, step: int, active: BoolArray) -> None:
        points, grid = self.points, active.reshape(len(self.points.x), -1)
        across = grid[:, -1].any() or (not points.symmetric and grid[:, 0].any())
        along = grid[0].any() or grid[-1].any()
        if not (along or across):
            return
        lines, way = (points.wheel_y, "across") if across else (points.wheel_x, "along")
        key = "contact_half_width" if across else "contact_half_length"
        raise NumericalError(
            f"contact patch reaches the edge of the finely meshed zone {way} the rail at step "
            f"{step}, X = {self.positions[step]:.4f} m: the wheel's zone, {1e3 * lines[0]:.4g} to "
            f"{1e3 * lines[-1]:.4g} mm, is too small ({key})"
        )
