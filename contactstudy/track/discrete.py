"""What every discretised track offers, beam or solid."""

from abc import ABC, abstractmethod
from typing import Protocol

import numpy as np
import scipy.sparse as sp

from contactstudy.track.model import Track
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
        """Damping matrix (n_dofs, n_dofs) [N s/m]."""

    @property
    def stiffness(self) -> sp.csr_array:
        """Stiffness matrix (n_dofs, n_dofs) [N/m]."""

    def rail_rows(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Dofs and weights (m, k) of the displacement of the rail's centre line at X (m,)."""

    def local_compliance(self, x: np.ndarray) -> np.ndarray:
        """Compliance under the load that the dofs leave out, (m,) [m/N]."""


class AssembledTrack(ABC):
    """The matrices of a discretised track, taken from its assembly of rail and supports."""

    @property
    @abstractmethod
    def _assembled(self) -> SupportedRail:
        """Rail and supports, end conditions eliminated; made once."""

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
    def stiffness(self) -> sp.csr_array:
        """Stiffness matrix (n_dofs, n_dofs)."""
        return self._assembled.stiffness
