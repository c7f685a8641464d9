"""The track with its rail as a three-dimensional solid: a chain of condensed cells."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.exceptions import InputError
from contactstudy.solids.bodies import rail_body
from contactstudy.solids.cache import cached
from contactstudy.solids.cell import RailCell, section_mesh_of
from contactstudy.solids.pair import CellPair, cell_pair
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.cell_chain import MOTIONS, CellChain
from contactstudy.track.discrete import without_held
from contactstudy.track.model import DiscreteSupports, Rail, Track, WinklerFoundation, whole
from contactstudy.track.stretch import RailStretch, SectionResponse
from contactstudy.track.supports import SupportedRail, add_supports
from contactstudy.track.top_load import AssembledMesh


@lru_cache(maxsize=8)
def solid_rail(recipe: CellRecipe) -> Rail:
    """Beam properties of the rail that a recipe meshes: integrals over its very section mesh."""
    return Rail(
        section=section_mesh_of(recipe).properties(recipe.poisson_ratio),
        youngs_modulus=recipe.youngs_modulus,
        poisson_ratio=recipe.poisson_ratio,
        density=recipe.density,
        profile_name=recipe.profile,
    )


def meshed_track(recipe: CellRecipe | None = None, **of_track: Any) -> "SolidTrack":
    """A `Track` with these parameters on a meshed rail, its cell condensed or from the cache."""
    recipe = recipe or CellRecipe()
    return SolidTrack(Track(rail=solid_rail(recipe), **of_track), cached(rail_body(recipe)))


@dataclass(frozen=True)
class SolidTrack(AssembledMesh):
    """A discretised track whose rail is a chain of equal condensed cells.

    Parameters
    ----------
    track : Track
        Its rail must be the one that the cell's recipe makes, see `solid_rail`.
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
        if self.track.structure is not None:
            problems.append("SolidTrack.track: stands on a bridge, whose rails are beams")
        discrete = isinstance(self.track.support, DiscreteSupports)
        what, length = ("bay", self.track.bay_length) if discrete else ("track", self.track.length)
        ratio = length / recipe.length
        if not whole(ratio):
            problems.append(
                f"cell length = {recipe.length} m: must divide the {what} of {length} m"
            )
        if self.n_cells < 4:
            problems.append(f"track length = {self.track.length} m: must hold at least 4 cells")
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
    def surface_arc(self) -> Array:
        """Arc lengths of the running-surface nodes from the crown [m]."""
        return self.cell.surface_arc

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return round(self.track.length / self.recipe.length)

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """See `DiscreteTrack`."""
        return self._rows(self.cell.centre_map[:, 0], x)

    def crown_rows(self, x: Array) -> tuple[IntArray, Array]:
        """The same of the running surface at the crown."""
        return self._rows(self.cell.surface_map[:, np.abs(self.surface_arc).argmin()], x)

    def _rows(self, rows: Array, x: Array) -> tuple[IntArray, Array]:
        """Dofs and weights (m, k) at X (m,) of what has a row of a cell (ns + 1, nd) a plane."""
        cell, slices, t = self._chain.locate(x)
        weights = (1 - t)[:, None] * rows[slices] + t[:, None] * rows[slices + 1]
        first = cell * self._chain.step
        dofs = self._dof_of_bare[first[:, None] + np.arange(weights.shape[1])]
        return without_held(dofs, weights)

    def local_compliance(self, x: Array) -> Array:
        """What the condensed cells leave out of the deflection under a load at X, (m,) [m/N].

        For a load spread over the section, which is what a point law on this rail applies.
        """
        _, slices, t = self._chain.locate(x)
        own, following = self.cell.centre_compliance
        # the load is shared by the planes on both sides, and so is the deflection
        return np.asarray(
            (1 - t) ** 2 * own[slices]
            + 2 * t * (1 - t) * following[slices]
            + t**2 * own[slices + 1]
        )

    def stretch(self, x: float, half_length: float) -> RailStretch:
        """Running surface around X, as the contact sees it.

        Raises
        ------
        InputError
            If the stretch does not fit on two cells around X or leaves the track.
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
        return RailStretch(
            key=pair,
            dofs=dofs,
            map=np.where(held, 0.0, rows) if held.any() else rows,
            residual=maps.residual[planes, :, planes].reshape(nodes, nodes),
            local=self._local if self.mean_phase else None,
            x=pair * self.recipe.length + h * np.arange(planes.start, planes.stop, dtype=float),
            y=self.cell.surface_y,
            arc=self.cell.surface_arc,
            centre_dofs=dofs,
            centre_map=np.where(held, 0.0, mean),
            centre_residual=mean_residual[:, planes].reshape(len(mean), -1),
        )

    def section(self, x: float, half_length: float) -> SectionResponse:
        """Displacement of the rail's section at the interface plane nearest to X."""
        pair, _, planes = self._planes(x, half_length)
        dofs, held = self._pair_dofs(pair)
        middle = slice(self._chain.step, self._chain.step + self.recipe.interface_modes)
        mesh = section_mesh_of(self.recipe)
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
        """First of the two cells around X, X in slices from its start, planes of a stretch."""
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
    def residual_period(self) -> int | None:
        """Slices after which the mean residual flexibility repeats; None where no mean is taken."""
        return self.recipe.n_slices if self.mean_phase else None

    def _pair_dofs(self, pair: int) -> tuple[IntArray, BoolArray]:
        first = pair * self._chain.step
        dofs = self._dof_of_bare[first : first + 2 * self._chain.step + self.recipe.interface_modes]
        held = dofs < 0
        # a held dof has weight 0 everywhere; name a free neighbour in its place
        return np.where(held, dofs.max(), dofs), held

    @cached_property
    def _pair(self) -> CellPair:
        return cell_pair(self.cell)

    @cached_property
    def _local(self) -> Array:
        """Static flexibility of two cells between held outer planes, zero on those."""
        m, step = self.recipe.interface_modes, self._chain.step
        n, K = len(self.cell.stiffness), np.zeros((2 * step + m,) * 2)
        K[:n, :n] += self.cell.stiffness
        K[step:, step:] += self.cell.stiffness
        F, inner = np.zeros_like(K), slice(m, 2 * step)
        F[inner, inner] = np.linalg.inv(K[inner, inner])
        return 0.5 * (F + F.T)

    @cached_property
    def _chain(self) -> CellChain:
        return CellChain(self.cell, self.n_cells, self.track.ends)

    @cached_property
    def _dof_of_bare(self) -> IntArray:
        """Final dof of each bare dof of the chain, -1 where held."""
        final = np.full(self._chain.n_bare, -1, dtype=np.int64)
        final[self._chain.free] = self._assembled.rail_dofs
        return final

    @cached_property
    def _assembled(self) -> SupportedRail:
        chain, stiffness, damping = self._chain, self.cell.stiffness, None
        if isinstance(self.track.support, WinklerFoundation):
            damping = np.zeros_like(stiffness)
            beds = [chain.bed(i) for i in range(self.cell.foot_map.shape[1])]
            for bed, (k, c) in zip(beds, self.track.support.foot_values(), strict=False):
                stiffness, damping = stiffness + k * bed, damping + c * bed
        return add_supports(
            chain.matrix(self.cell.mass),
            None if damping is None else chain.matrix(damping),
            chain.matrix(stiffness),
            chain.keys,
            self.track,
            {
                motion: [chain.pad_row(first, last, i) for first, last in self.track.pad_footprints]
                for i, motion in enumerate(MOTIONS[: self.cell.foot_map.shape[1]])
            },
        )
