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

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.contact.augmented import Enforcement, PointProblem
from contactstudy.contact.groups import patch_record
from contactstudy.contact.moving_wheel import MovingWheel
from contactstudy.contact.nearby import NearbyColumns
from contactstudy.contact.rail_surface import RailSurface, RailUnderWheel
from contactstudy.contact.wheel_path import WheelPath
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.stepper import ContactStep
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.points import EDGE_KEYS, EdgeReachedError
from contactstudy.geometry.search import CandidateList
from contactstudy.track.meshed import MeshedTrack
from contactstudy.track.stretch import SectionResponse

NEAR = 0.3e-6
"""Points whose gap was below this [m] a step before enter the dense problem from the start."""


@dataclass(frozen=True, eq=False)
class PatchState:
    """Contact at the end of a step, at all points.

    Attributes
    ----------
    forces : ndarray (n,)
        Normal forces in N.
    gap : ndarray (n,)
        Gaps in m; minus the penetration where there is a force.
    active : ndarray of bool (n,)
        Points in contact.
    overlap : ndarray (n,)
        Penetration in m that the enforcement leaves.
    surface_load : ndarray (nodes,)
        Nodal forces on the stretch of rail, in N, positive into the rail.
    """

    forces: Array
    gap: Array
    active: BoolArray
    overlap: Array
    surface_load: Array


@dataclass(frozen=True, eq=False)
class SurfaceCoupling:
    """Pressure on the points of one wheel; the track's dofs are the first ones of the system."""

    track: MeshedTrack
    wheel: MovingWheel
    path: WheelPath
    candidates: CandidateList
    enforcement: Enforcement

    @cached_property
    def rail(self) -> RailSurface:
        """The track's running surface at the wheel's points."""
        return RailSurface(self.track, self.wheel.points)

    @property
    def accuracy(self) -> float:
        """Relative accuracy of the forces."""
        return self.enforcement.accuracy

    def start(self) -> PatchState:
        """Nothing touches: the undeformed bodies at zero approach."""
        gap = self.wheel.points.gap
        none = np.zeros(len(gap))
        return PatchState(none, gap, np.zeros(len(gap), dtype=bool), none, np.zeros(0))

    def section(self, x: float) -> SectionResponse:
        """Displacement of the rail's section near X [m]."""
        return self.track.section(x, self.rail.half_length)

    def attached(self, factor: Factor, scale: float) -> "AttachedSurface":
        """Join to a system."""
        return AttachedSurface(self, factor, scale)


class AttachedSurface:
    """A `SurfaceCoupling` on the system with the compliance scale * S^-1.

    Between calls it keeps what repeats, and no state of the contact: the columns of S^-1 near the
    wheel, and the points on the facets listed last.
    """

    def __init__(self, coupling: SurfaceCoupling, factor: Factor, scale: float) -> None:
        self._coupling, self._scale = coupling, scale
        self._near = NearbyColumns(factor)
        wheel = coupling.wheel
        unit = np.zeros((factor.n, len(wheel.dofs)))
        unit[wheel.dofs, np.arange(len(wheel.dofs))] = 1.0
        columns = factor.solve(unit)
        self._vehicle = np.flatnonzero(columns.any(axis=1))
        self._vehicle_response = scale * columns[self._vehicle]
        compliance = columns[wheel.dofs]
        moving = wheel.map @ (0.5 * scale * (compliance + compliance.T)) @ wheel.map.T
        # the whole wheel: its inertia and modes, and its flexibility
        self._wheel_W = wheel.flexibility + moving
        self._compliance = coupling.enforcement.compliance(wheel.points.area)
        self._listed: tuple[IntArray, BoolArray] | None = None

    def __call__(self, step: int, u_free: Array, state: PatchState) -> ContactStep:
        """Forces at the end of a step."""
        coupling, wheel, near = self._coupling, self._coupling.wheel, self._near
        points, normal = wheel.points, wheel.points.normal_z
        under = coupling.rail.under(float(coupling.path.positions[step]))
        stretch = under.stretch
        near.move_to(stretch)
        roughness = coupling.path.level(step, len(points.y))
        free = (
            points.gap
            + wheel.map @ u_free[wheel.dofs]
            - roughness * normal
            - under.at_points(stretch.map @ u_free[stretch.dofs])
        )
        allowed = self._candidates(float(((points.gap - free) / normal).max()))
        new = self._solve(step, under, free, state, allowed)
        load = np.zeros(len(u_free))
        # a dof may be named twice, where an end of the track is held
        modal = stretch.map.T @ new.surface_load
        np.subtract.at(load, stretch.dofs, modal)
        on_wheel = new.forces @ wheel.map
        load[wheel.dofs] += on_wheel
        # scale S^-1 load from the columns at hand, which is cheaper than another solution
        increment = np.zeros(len(u_free))
        increment[near.reach] = -self._scale * (modal @ near.response)
        increment[self._vehicle] += self._vehicle_response @ on_wheel
        record: dict[str, Array | float] = {
            "contact_force": np.array([float(normal @ new.forces)]),
            "peak_pressure": wheel.peak_pressure(new.forces),
            "penetration": float(new.overlap.max()),
            **patch_record(points, new.gap, new.forces),
            **stretch.centre_motion(u_free, increment, new.surface_load),
        }
        return ContactStep(load, increment, record, new)

    def _solve(
        self, step: int, under: RailUnderWheel, free: Array, before: PatchState, allowed: BoolArray
    ) -> PatchState:
        """Contact for given free gaps (n,).

        The dense problem holds the points that were near contact only. Its solution is checked at
        all points; those found overlapping join, so the restriction never changes the result.
        """
        n, H = len(free), under.stretch.map
        C = under.beyond(self._scale * self._near.compliance)
        chosen = before.gap < NEAR
        for _ in range(20):
            index = np.flatnonzero(chosen)
            forces, active, overlap = np.zeros(n), np.zeros(n, dtype=bool), np.zeros(n)
            nodal = np.zeros(len(H))
            if len(index):
                P = under.rows(index)
                PH = P @ H
                W = PH @ C @ PH.T
                W += under.residual.block(index)
                W += self._wheel_W[index[:, None], index]
                W.flat[:: len(index) + 1] += self._compliance[index]
                problem = PointProblem(
                    W,
                    free[index],
                    self._compliance[index],
                    before.forces[index],
                    before.active[index],
                )
                solution, overlap[index] = self._coupling.enforcement.forces(problem)
                forces[index], active[index] = solution.forces, solution.active
                nodal = P.T @ solution.forces
            loaded = np.flatnonzero(forces)
            pressing = forces[loaded]
            gap = (
                free
                + pressing @ self._wheel_W[loaded]
                + under.residual.product(loaded, pressing)
                + under.at_points(H @ (C @ (H.T @ nodal)))
            )
            missed = ~chosen & (gap < -1e-12)
            if not missed.any():
                self._check_edge(step, active)
                return PatchState(forces, gap, active, overlap, nodal)
            if np.any(missed & ~allowed):
                raise NumericalError(
                    f"contact search missed points in contact at {self._where(step)}: gap "
                    f"{gap[missed & ~allowed].min():.3e} m outside the candidate facets"
                )
            chosen = chosen | missed
        raise NumericalError(
            f"contact: the set of points near contact does not settle at {self._where(step)} "
            f"({len(index)} of {n} points)"
        )

    def _candidates(self, approach: float) -> BoolArray:
        """Points (n,) on facets that can touch."""
        facets = self._coupling.candidates.quads(approach)
        if self._listed is None or self._listed[0] is not facets:
            self._listed = facets, self._coupling.wheel.points.listed(facets)
        return self._listed[1]

    def _check_edge(self, step: int, active: BoolArray) -> None:
        """Raise if an outermost line of points is in contact, naming the key of the small zone."""
        points = self._coupling.wheel.points
        way = points.edge_reached(active)
        if not way:
            return
        lines = points.wheel_y if way == "across" else points.wheel_x
        raise EdgeReachedError(
            f"contact patch reaches the edge of the finely meshed zone {way} the rail at "
            f"{self._where(step)}: the wheel's zone, {1e3 * lines[0]:.4g} to "
            f"{1e3 * lines[-1]:.4g} mm, is too small ({EDGE_KEYS[way]})",
            way,
        )

    def _where(self, step: int) -> str:
        return f"step {step}, X = {self._coupling.path.positions[step]:.4f} m"
