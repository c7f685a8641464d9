"""What every discretised track offers, beam or solid."""

from abc import ABC, abstractmethod
from typing import Protocol

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.track.model import Track
from contactstudy.track.rail import Direction
from contactstudy.track.supports import SupportedRail


class DiscreteTrack(Protocol):
    """A discretised track as solvers and receptances see it."""

    @property
    def track(self) -> Track:
        """The track that is discretised."""

    @property
    def n_dofs(self) -> int:
        """Number of dofs."""

    @property
    def mass(self) -> sp.csr_array:
        """Mass matrix (n_dofs, n_dofs) [kg]."""

    @property
    def damping(self) -> sp.csr_array:
        """Damping matrix (n_dofs, n_dofs) [N s/m], without `dampers`."""

    @property
    def dampers(self) -> sp.csr_array | None:
        """Rows G (r, n_dofs) of dampers over whole decks, whose damping matrix is G^T G."""

    @property
    def stiffness(self) -> sp.csr_array:
        """Stiffness matrix (n_dofs, n_dofs) [N/m]."""

    @property
    def direction(self) -> Direction:
        """Vertical or lateral displacements of the rail."""

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """Dofs and weights (m, k) of the displacement of the rail's centre line at X (m,) [m].

        u(x) = sum(weights * u[dofs]); a dof that an end condition holds has weight 0.
        """

    def contact_rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        """The same of one of the rails, in a direction, as a wheel at X (m,) feels it."""

    def on_track(self, x: Array) -> Array:
        """Share of a wheel at X (...) that the track carries, 0 on ground beyond its ends."""

    def local_compliance(self, x: Array) -> Array:
        """Compliance under the load that the dofs leave out, (m,) [m/N]."""

    def top_load_compliance(self, x: Array) -> Array:
        """What a wheel's load adds for it acts on top of the rail, (m,) [m/N]; may be negative.

        Against the load on the centre line, and with a contact spring that is the tangent of
        the press in mid-bay, see `track.top_load`; a beam has none.
        """


def pieces_at(x: Array, length: float, n: int) -> tuple[IntArray, Array]:
    """Piece of a chain of n equal ones, and place in it from 0 to 1, of each X (m,)."""
    scaled = np.atleast_1d(np.asarray(x, dtype=float)) / length
    piece = np.clip(np.floor(scaled).astype(np.int64), 0, n - 1)
    return piece, scaled - piece


def without_held(dofs: IntArray, weights: Array) -> tuple[IntArray, Array]:
    """Rows whose dofs -1, held by an end condition, are named 0 with weight 0."""
    held = dofs < 0
    return np.where(held, 0, dofs), np.where(held, 0.0, weights)


def not_discrete(track: object) -> list[str]:
    """Return the complaint (or nothing) about a track that is not discretised."""
    if hasattr(type(track), "rail_rows"):
        return []
    return [
        f"track: a {type(track).__name__} is no track; give a Track, a BeamTrack or a SolidTrack"
    ]


class AssembledTrack(ABC):
    """The matrices of a discretised track, taken from its assembly of rail and supports."""

    @property
    @abstractmethod
    def _assembled(self) -> SupportedRail:
        """Rail and supports, end conditions eliminated; made once."""

    @abstractmethod
    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """See `DiscreteTrack`."""

    def contact_rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        """Those of the one rail, in the track's direction."""
        return self.rail_rows(x)

    def on_track(self, x: Array) -> Array:
        """All of it: wheels stay on the track."""
        return np.ones(np.shape(x))

    @property
    def n_dofs(self) -> int:
        """Number of dofs, end conditions eliminated."""
        return self._assembled.stiffness.shape[0]

    @property
    def mass(self) -> sp.csr_array:
        """Mass matrix (n_dofs, n_dofs)."""
        return self._assembled.mass

    @property
    def damping(self) -> sp.csr_array:
        """Damping matrix (n_dofs, n_dofs): pads, ballast or foundation."""
        return self._assembled.damping

    @property
    def dampers(self) -> sp.csr_array | None:
        """None but on a bridge."""
        return None

    @property
    def stiffness(self) -> sp.csr_array:
        """Stiffness matrix (n_dofs, n_dofs)."""
        return self._assembled.stiffness
