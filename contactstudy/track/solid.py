"""The track with its rail as a three-dimensional solid: a chain of condensed cells."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from contactstudy.exceptions import InputError
from contactstudy.solids.cell import RailCell, section_of
from contactstudy.solids.pair import CellPair, cell_pair
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.discrete import AssembledTrack
from contactstudy.track.model import DiscreteSupports, Rail, Track, WinklerFoundation
from contactstudy.track.patch import SectionResponse, SurfacePatch
from contactstudy.track.supports import PadRow, SupportedRail, add_supports

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]

# coordinates of an interface plane that are its rigid motions, see `interface_basis`
_AXIAL, _VERTICAL = 0, 1


def solid_rail(recipe: CellRecipe) -> Rail:
    """Beam properties of the rail that a recipe meshes: integrals over its very section mesh."""
    section, _, _ = section_of(recipe)
    return Rail(
        section=section.properties(recipe.poisson_ratio),
        youngs_modulus=recipe.youngs_modulus,
        poisson_ratio=recipe.poisson_ratio,
        density=recipe.density,
        profile_name=recipe.profile,
    )


@dataclass(frozen=True)
class SolidTrack(AssembledTrack):
    """A discretised track whose rail is a chain of equal condensed cells.

    Parameters
    ----------
    track : Track
        Its rail must be the one that the cell's recipe makes, see `solid_rail`.
    cell : RailCell
    mean_phase : bool
        Take the residual flexibility of the running surface as the mean over the phases of the
        mesh under the wheel, see `contact.residual`. False: exactly that of the mesh, with its
        ripple; for comparisons with the `UnreducedTrack`.

    Raises
    ------
    InputError
        If the cells do not divide the bays (or the length, where there are none), or rail and
        cell are not of the same stuff.
    """

    track: Track
    cell: RailCell
    mean_phase: bool = True

    def __post_init__(self) -> None:
        recipe, rail, problems = self.recipe, self.track.rail, []
        discrete = isinstance(self.track.support, DiscreteSupports)
        what, length = ("bay", self.track.bay_length) if discrete else ("track", self.track.length)
        ratio = length / recipe.length
        if abs(ratio - round(ratio)) > 1e-9 * ratio:
            problems.append(
                f"cell length = {recipe.length} m: must divide the {what} of {length} m"
            )
        if self.n_cells < 4:
            problems.append(f"track length = {self.track.length} m: must hold at least 4 cells")
        if not recipe.symmetric:
            problems.append("symmetric = False: a track needs the symmetric half section")
        same = (
            (rail.profile_name, recipe.profile, "profile"),
            (rail.youngs_modulus, recipe.youngs_modulus, "youngs_modulus in Pa"),
            (rail.poisson_ratio, recipe.poisson_ratio, "poisson_ratio"),
            (rail.density, recipe.density, "density in kg/m^3"),
        )
        problems += [
            f"{name}: the rail has {ours}, the solid cell {theirs}; both must be the same"
            for ours, theirs, name in same
            if ours != theirs
        ]
        if problems:
            raise InputError(problems)

    @property
    def recipe(self) -> CellRecipe:
        """Mesh and reduction of the rail."""
        return self.cell.recipe

    @property
    def surface_y(self) -> Array:
        """Lateral positions of the running-surface nodes [m]."""
        return self.cell.surface_y

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return round(self.track.length / self.recipe.length)

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """Rows that give the deflection of the rail's centre line at X.

        Parameters
        ----------
        x : ndarray
            (m,) positions on the track [m].

        Returns
        -------
        dofs : ndarray
            (m, nd) int64.
        weights : ndarray
            (m, nd); u(x) = sum(weights * u[dofs]). A dof that an end condition holds has
            weight 0.
        """
        cell, slices, t = self._locate(np.atleast_1d(np.asarray(x, dtype=float)))
        rows = self.cell.centre_map
        weights = (1 - t)[:, None] * rows[slices] + t[:, None] * rows[slices + 1]
        return self._placed(cell * self._step, weights)

    def local_compliance(self, x: Array) -> Array:
        """What the condensed cells leave out of the deflection under a load at X, (m,) [m/N].

        For a load spread over the section, which is what a point law on this rail applies.
        """
        _, slices, t = self._locate(np.atleast_1d(np.asarray(x, dtype=float)))
        own, following = self.cell.centre_compliance
        # the load is shared by the planes on both sides, and so is the deflection
        return np.asarray(
            (1 - t) ** 2 * own[slices]
            + 2 * t * (1 - t) * following[slices]
            + t**2 * own[slices + 1]
        )

    def patch(self, x: float, half_length: float) -> SurfacePatch:
        """Running surface around X, as the contact sees it.

        Parameters
        ----------
        x : float
            Position of the wheel on the track [m].
        half_length : float
            The patch covers at least ``x - half_length`` to ``x + half_length`` [m].

        Returns
        -------
        SurfacePatch

        Raises
        ------
        InputError
            If the patch does not fit on two cells around X or leaves the track.
        """
        pair, local, planes = self._planes(x, half_length)
        dofs, held = self._pair_dofs(pair)
        maps, h = self._pair, self.thickness
        nodes = (planes.stop - planes.start) * maps.surface.shape[1]
        rows = maps.surface[planes].reshape(nodes, -1)
        at = min(max(int(np.floor(local)), 0), len(maps.centre) - 2)
        t = local - at
        mean = (1 - t) * maps.centre[at] + t * maps.centre[at + 1]
        mean_residual = (1 - t) * maps.centre_residual[at] + t * maps.centre_residual[at + 1]
        return SurfacePatch(
            key=pair,
            dofs=dofs,
            map=np.where(held, 0.0, rows) if held.any() else rows,
            residual=maps.residual[planes, :, planes].reshape(nodes, nodes),
            x=pair * self.recipe.length + h * np.arange(planes.start, planes.stop, dtype=float),
            y=self.cell.surface_y,
            centre_dofs=dofs,
            centre_map=np.where(held, 0.0, mean),
            centre_residual=mean_residual[planes].ravel(),
        )

    def section(self, x: float, half_length: float) -> SectionResponse:
        """Displacement of the rail's section at the interface plane nearest to X.

        Parameters
        ----------
        x, half_length : float
            As for `patch`, whose nodal forces the residual belongs to.

        Returns
        -------
        SectionResponse
        """
        pair, _, planes = self._planes(x, half_length)
        dofs, held = self._pair_dofs(pair)
        middle = slice(self._step, self._step + self.recipe.interface_modes)
        mesh, _, _ = section_of(self.recipe)
        k = len(mesh.nodes)
        return SectionResponse(
            position=(pair + 1) * self.recipe.length,
            nodes=mesh.nodes,
            quads=mesh.quads,
            dofs=dofs[middle],
            map=np.where(held[middle], 0.0, self.cell.section_map).reshape(k, 2, -1),
            residual=self._pair.section_residual[:, :, planes].reshape(k, 2, -1),
        )

    def _planes(self, x: float, half_length: float) -> tuple[int, float, slice]:
        """First of the two cells around X, X in slices from its start, planes of a patch."""
        length, h = self.recipe.length, self.thickness
        pair = min(max(int(np.floor(x / length - 0.5)), 0), self.n_cells - 2)
        local = (x - pair * length) / h
        first = int(np.floor(local - half_length / h))
        stop = first + int(np.ceil(2 * half_length / h)) + 2
        if first < 0 or stop > 2 * self.recipe.n_slices + 1:
            raise InputError(
                f"contact patch at X = {x:.4f} m with half length {half_length} m does not lie "
                f"within two rail cells of {length} m on the track"
            )
        return pair, local, slice(first, stop)

    @property
    def thickness(self) -> float:
        """Length of a slice of the mesh [m]."""
        return self.recipe.length / self.recipe.n_slices

    @property
    def residual_period(self) -> int | None:
        """Slices after which the mean residual flexibility repeats; None where no mean is taken."""
        return self.recipe.n_slices if self.mean_phase else None

    @property
    def _step(self) -> int:
        """Bare dofs of one plane and one cell's internal modes."""
        return self.recipe.interface_modes + self.recipe.internal_modes

    def _locate(self, x: Array) -> tuple[IntArray, IntArray, Array]:
        """Cell, slice in it and fraction of the slice of each X."""
        ns = self.recipe.n_slices
        scaled = x / self.thickness
        index = np.clip(np.floor(scaled).astype(np.int64), 0, self.n_cells * ns - 1)
        return index // ns, index % ns, scaled - index

    def _placed(self, first: IntArray, weights: Array) -> tuple[IntArray, Array]:
        """Weights on the bare dofs from `first` on, as final dofs; held ones get weight 0."""
        dofs = self._dof_of_bare[first[:, None] + np.arange(weights.shape[1])]
        held = dofs < 0
        return np.where(held, 0, dofs), np.where(held, 0.0, weights)

    def _pair_dofs(self, pair: int) -> tuple[IntArray, NDArray[np.bool_]]:
        first = pair * self._step
        dofs = self._dof_of_bare[first : first + 2 * self._step + self.recipe.interface_modes]
        held = dofs < 0
        # a held dof has weight 0 everywhere; name a free neighbour in its place
        return np.where(held, dofs.max(), dofs), held

    @cached_property
    def _pair(self) -> CellPair:
        return cell_pair(self.cell)

    @cached_property
    def _held(self) -> IntArray:
        """Bare dofs that the end conditions hold.

        Nothing else holds the rail along X, so ends that leave it free to slide are held
        there by one axial coordinate.
        """
        m, last = self.recipe.interface_modes, self.n_cells * self._step
        if self.track.ends == "clamped":
            return np.r_[0:m, last : last + m]
        if self.track.ends == "pinned":
            return np.array([_AXIAL, _VERTICAL, last + _VERTICAL])
        return np.array([_AXIAL])

    @cached_property
    def _dof_of_bare(self) -> IntArray:
        """Final dof of each bare dof, -1 where held."""
        n = self.n_cells * self._step + self.recipe.interface_modes
        final = np.full(n, -1, dtype=np.int64)
        final[np.setdiff1d(np.arange(n), self._held)] = self._assembled.rail_dofs
        return final

    @cached_property
    def _assembled(self) -> SupportedRail:
        cell, step, n_cells = self.cell, self._step, self.n_cells
        nd, m = len(cell.stiffness), cell.recipe.interface_modes
        n = n_cells * step + m
        dofs = step * np.arange(n_cells)[:, None] + np.arange(nd)
        free = np.setdiff1d(np.arange(n), self._held)

        def chain(A: Array) -> sp.csr_array:
            rows, columns = np.repeat(dofs, nd, axis=1).ravel(), np.tile(dofs, (1, nd)).ravel()
            total = sp.csr_array((np.tile(A.ravel(), n_cells), (rows, columns)), shape=(n, n))
            return total[free][:, free]

        stiffness, damping = cell.stiffness, None
        if isinstance(self.track.support, WinklerFoundation):
            # integral of f f^T dx, f = mean displacement of the foot, linear between planes
            f, h = cell.foot_map, self.thickness
            bed = (
                h
                / 6
                * (2 * (f[:-1].T @ f[:-1] + f[1:].T @ f[1:]) + f[:-1].T @ f[1:] + f[1:].T @ f[:-1])
            )
            k, c = self.track.support.values("Z")
            stiffness, damping = stiffness + k * bed, chain(c * bed)
        bare = np.arange(n)
        keys = cell.recipe.length * (bare // step + 0.5 * (bare % step >= m))
        place = np.full(n, -1, dtype=np.int64)
        place[free] = np.arange(len(free))
        return add_supports(
            chain(cell.mass),
            damping,
            chain(stiffness),
            keys[free],
            self.track,
            [self._pad_row(first, last, place) for first, last in self.track.pad_footprints],
        )

    def _pad_row(self, first: float, last: float, place: IntArray) -> PadRow:
        """Average foot displacement over a footprint, linear between the planes."""
        h = self.thickness
        inner = h * np.arange(np.ceil(first / h), np.floor(last / h) + 1)
        knots = np.unique(np.clip(np.r_[first, inner, last], first, last))
        # trapezoids between knots are exact for a piecewise linear function
        weight = np.full(len(knots), 1.0 if len(knots) == 1 else 0.0)
        share = 0.5 * np.diff(knots) / (last - first if last > first else 1.0)
        weight[:-1] += share
        weight[1:] += share
        cells, index, t = self._locate(knots)
        row = np.zeros(len(place))
        for c, i, s, w in zip(cells, index, t, weight, strict=True):
            start = c * self._step
            f = (1 - s) * self.cell.foot_map[i] + s * self.cell.foot_map[i + 1]
            row[start : start + len(f)] += w * f
        # equal pads get equal rows bit for bit, so that products with them can share values
        row = np.round(row, 12)
        used = np.flatnonzero((row != 0.0) & (place >= 0))
        return PadRow(place[used], row[used])
