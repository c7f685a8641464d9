"""The track with every node of its solid rail: the check on the condensed cells.

Same mesh, same supports, no reduction. Only short rails are practical.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.solids.cell import section_of
from contactstudy.solids.chain import Slice
from contactstudy.solids.extrusion import ExtrudedSlice
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.section_mesh import SectionMesh
from contactstudy.solids.section_rows import SectionRows
from contactstudy.track.cell_chain import MOTIONS
from contactstudy.track.discrete import pieces_at, without_held
from contactstudy.track.model import Track, WinklerFoundation, whole
from contactstudy.track.stretch import RailStretch, SectionResponse
from contactstudy.track.supports import PadRow, SupportedRail, add_supports
from contactstudy.track.top_load import AssembledMesh


@dataclass(frozen=True)
class UnreducedTrack(AssembledMesh):
    """A discretised track that keeps all nodes of the rail's mesh.

    Parameters
    ----------
    recipe : CellRecipe
        Mesh; its cell length only sets the length of a slice, as in the condensed track.

    Raises
    ------
    InputError
        If the ends are not clamped or the slices do not divide the track.
    """

    track: Track
    recipe: CellRecipe

    def __post_init__(self) -> None:
        problems = []
        if self.track.ends != "clamped":
            problems.append(f"track ends = {self.track.ends!r}: must be 'clamped' here")
        if not whole(self.track.length / self.recipe.length):
            problems.append(
                f"cell length = {self.recipe.length} m: must divide the track of "
                f"{self.track.length} m"
            )
        if problems:
            raise InputError(problems)

    @property
    def residual_period(self) -> int | None:
        """None: there is no residual."""
        return None

    @property
    def n_slices(self) -> int:
        """Slices of the whole track."""
        return round(self.track.length / self.thickness)

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """See `DiscreteTrack`: the section's mean deflection."""
        index, t = self._locate(x)
        centre = self._rows.centre[0]
        used = np.flatnonzero(centre)
        dofs = self._place[index[:, None] * self._n + np.r_[used, self._n + used]]
        weights = np.hstack([(1 - t)[:, None] * centre[used], t[:, None] * centre[used]])
        return without_held(dofs, weights)

    def local_compliance(self, x: Array) -> Array:
        """Zero, (m,) [m/N]: no dof of the mesh is left out."""
        return np.zeros(np.atleast_1d(x).shape)

    def stretch(self, x: float, half_length: float) -> RailStretch:
        """Running surface around X, as `SolidTrack.stretch`, with no residual left."""
        h, n = self.thickness, self._n
        first = int(np.floor((x - half_length) / h))
        last = first + int(np.ceil(2 * half_length / h)) + 1
        if first < 1 or last > self.n_slices - 1:
            raise InputError(
                f"contact patch at X = {x:.4f} m with half length {half_length} m leaves the track"
            )
        normal = self._rows.surface
        used = np.flatnonzero(np.any(normal != 0.0, axis=0))
        planes = np.arange(first, last + 1)
        rows = np.asarray(np.kron(np.eye(len(planes)), normal[:, used]), dtype=float)
        (at,), (t,) = self._locate(np.array([x]))
        mean_dofs = np.flatnonzero(self._rows.centre.any(axis=0))
        centre = self._rows.centre[:, mean_dofs]
        return RailStretch(
            key=first,
            dofs=self._place[(planes[:, None] * n + used).ravel()],
            map=rows,
            residual=np.zeros((len(rows),) * 2),
            local=None,
            x=np.asarray(h * planes, dtype=float),
            y=self._rows.surface_y,
            arc=self._rows.surface_arc,
            centre_dofs=self._place[np.r_[at * n + mean_dofs, (at + 1) * n + mean_dofs]],
            centre_map=np.hstack([(1 - t) * centre, t * centre]),
            centre_residual=np.zeros((len(centre), len(rows))),
        )

    def section(self, x: float, half_length: float) -> SectionResponse:
        """Displacement of the plane nearest to X, as `SolidTrack.section`."""
        section, piece, _ = self._section
        plane, k = round(x / self.thickness), len(section.nodes)
        transverse = np.flatnonzero(piece.free % 3 > 0)
        chosen = np.zeros((3 * k, len(transverse)))
        chosen[piece.free[transverse], np.arange(len(transverse))] = 1.0
        return SectionResponse(
            position=plane * self.thickness,
            nodes=section.nodes,
            quads=section.quads,
            dofs=self._place[plane * self._n + transverse],
            map=chosen.reshape(k, 3, -1)[:, 1:],
            residual=np.zeros((k, 2, len(self.stretch(x, half_length).map))),
        )

    @property
    def surface_arc(self) -> Array:
        """Arc lengths of the running-surface nodes from the crown [m]."""
        return self._rows.surface_arc

    @cached_property
    def _section(self) -> tuple[SectionMesh, ExtrudedSlice, SectionRows]:
        return section_of(self.recipe)

    @property
    def _rows(self) -> SectionRows:
        return self._section[2]

    @property
    def _n(self) -> int:
        """Free dofs of a plane."""
        return len(self._rows.weights)

    def _locate(self, x: Array) -> tuple[IntArray, Array]:
        return pieces_at(x, self.thickness, self.n_slices)

    @cached_property
    def _place(self) -> IntArray:
        """Final dof of each dof of the mesh, -1 on the clamped planes."""
        n, planes = self._n, self.n_slices + 1
        final = np.full(n * planes, -1, dtype=np.int64)
        final[n : n * (planes - 1)] = self._assembled.rail_dofs
        return final

    @cached_property
    def _assembled(self) -> SupportedRail:
        piece, rows, n = self._section[1], self._rows, self._n
        inner = self.n_slices - 1
        stiffness, damping = _chain(piece.stiffness, inner), None
        if isinstance(self.track.support, WinklerFoundation):
            # integral of f f^T dx with f linear between planes
            h = self.thickness
            weights = sp.diags_array(
                [np.full(inner, 2 * h / 3), np.full(inner - 1, h / 6), np.full(inner - 1, h / 6)],
                offsets=[0, 1, -1],
            )
            damping = sp.csr_array(stiffness.shape)
            for foot, (k, c) in zip(rows.foot, self.track.support.foot_values(), strict=False):
                f = sp.csr_array(foot[:, None] @ foot[None, :])
                bed = sp.csr_array(sp.kron(weights, f))
                stiffness, damping = stiffness + k * bed, damping + c * bed
        return add_supports(
            _chain(piece.mass, inner),
            damping,
            stiffness,
            np.repeat(self.thickness * np.arange(1, inner + 1), n),
            self.track,
            {
                motion: [
                    self._pad_row(first, last, foot) for first, last in self.track.pad_footprints
                ]
                for motion, foot in zip(MOTIONS, rows.foot, strict=False)
            },
        )

    def _pad_row(self, first: float, last: float, foot: Array) -> PadRow:
        """Average motion of the foot over a footprint, linear between the planes."""
        # brute force: 4000 midpoints, so that this check shares no integration with SolidTrack
        x = first + (np.arange(4000) + 0.5) / 4000 * (last - first)
        index, t = self._locate(x)
        planes = np.bincount(index, 1 - t, self.n_slices + 1) / len(x)
        planes += np.bincount(index + 1, t, self.n_slices + 1) / len(x)
        row = (planes[1:-1, None] * foot).ravel()
        used = np.flatnonzero(row)
        return PadRow(used, row[used])


def _chain(block: Slice, inner: int) -> sp.csr_array:
    """Equal slices in a row, both end planes held."""
    ab = sp.csr_array(np.where(np.abs(block.ab) > 0, block.ab, 0.0))
    shift = sp.diags_array([np.ones(inner - 1)], offsets=[1], shape=(inner, inner))
    off = sp.kron(shift, ab)
    return sp.csr_array(
        sp.kron(sp.eye_array(inner), sp.csr_array(block.bb + block.aa)) + off + off.T
    )
