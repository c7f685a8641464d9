"""The track with its rail as a beam: cubic Hermite elements, Euler-Bernoulli or Timoshenko."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import scipy.sparse as sp

from contactstudy.track.hermite import BeamElement
from contactstudy.track.model import Direction, Track, WinklerFoundation
from contactstudy.track.supports import PadRow, SupportedRail, add_supports, chain_of
from contactstudy.validation import one_of, raise_if

RailTheory = Literal["euler", "timoshenko"]


@dataclass(frozen=True)
class BeamTrack:
    """A discretised track whose rail is a chain of equal beam elements.

    Parameters
    ----------
    track : Track
    theory : {"euler", "timoshenko"}
        Timoshenko elements have shear flexibility, their own shape functions and rotary inertia.
    elements_per_bay : int
    element_compliance : bool
        Whether `local_compliance` returns the compliance of the loaded element itself, which
        the shape functions leave out, or zero (the paper's scheme).
    direction : {"Z", "Y"}
        Vertical or lateral bending, with the supports' values for that direction.

    Raises
    ------
    InputError
        For an unknown theory or direction, or fewer than one element a bay.
    """

    track: Track
    theory: RailTheory = "euler"
    elements_per_bay: int = 4
    element_compliance: bool = False
    direction: Direction = "Z"

    def __post_init__(self) -> None:
        problems = one_of("rail_theory", self.theory, ("euler", "timoshenko"))
        problems += one_of("direction", self.direction, ("Z", "Y"))
        if self.elements_per_bay != int(self.elements_per_bay) or self.elements_per_bay < 1:
            problems.append(
                f"elements_per_bay = {self.elements_per_bay}: must be a whole number of at least 1"
            )
        raise_if(problems)

    @property
    def n_elements(self) -> int:
        """Number of beam elements."""
        return int(self.elements_per_bay) * self.track.n_bays

    @cached_property
    def element(self) -> BeamElement:
        """The one element that the rail consists of."""
        rail, length = self.track.rail, self.track.length / self.n_elements
        bending, mass = rail.bending_stiffness(self.direction), rail.mass_per_length
        if self.theory == "euler":
            return BeamElement(length, bending, mass)
        return BeamElement(
            length,
            bending,
            mass,
            rail.shear_stiffness(self.direction),
            rail.rotary_inertia(self.direction),
        )

    @property
    def n_dofs(self) -> int:
        """Number of dofs, end conditions eliminated."""
        return self.stiffness.shape[0]

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

    def rail_rows(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows that give the rail's deflection at X.

        Parameters
        ----------
        x : ndarray
            (m,) positions on the track [m].

        Returns
        -------
        dofs : ndarray
            (m, 4) int64.
        weights : ndarray
            (m, 4); u(x) = sum(weights * u[dofs]). A dof that an end condition holds has
            weight 0.
        """
        element, xi = self._locate(x)
        nodal = 2 * element[:, None] + np.arange(4)
        dofs = self._dof_of_nodal[nodal]
        weights = self.element.deflection_shapes(xi)
        held = dofs < 0
        return np.where(held, 0, dofs), np.where(held, 0.0, weights)

    def local_compliance(self, x: np.ndarray) -> np.ndarray:
        """Compliance of the loaded element itself at X, (m,) [m/N]; 0 when the option is off."""
        _, xi = self._locate(x)
        if not self.element_compliance:
            return np.zeros_like(xi)
        return self.element.clamped_compliance(xi)

    def _locate(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Element index and local coordinate in 0..1 of each X."""
        scaled = np.atleast_1d(np.asarray(x, dtype=float)) / self.element.length
        element = np.clip(np.floor(scaled).astype(np.int64), 0, self.n_elements - 1)
        return element, scaled - element

    @cached_property
    def _free(self) -> np.ndarray:
        """Nodal dofs (w and theta in turn) that the end conditions leave."""
        n = 2 * self.n_elements + 2
        held = {"clamped": [0, 1, n - 2, n - 1], "pinned": [0, n - 2], "free": []}
        return np.setdiff1d(np.arange(n), held[self.track.ends])

    @cached_property
    def _dof_of_nodal(self) -> np.ndarray:
        """Final dof of each nodal dof, -1 where held."""
        final = np.full(2 * self.n_elements + 2, -1, dtype=np.int64)
        final[self._free] = self._assembled.rail_dofs
        return final

    @cached_property
    def _assembled(self) -> SupportedRail:
        element, n = self.element, self.n_elements
        mass, stiffness = chain_of(element.mass(), n), chain_of(element.stiffness(), n)
        damping = None
        if isinstance(self.track.support, WinklerFoundation):
            k, c = self.track.support.values(self.direction)
            bed = chain_of(element.foundation(), n)
            stiffness, damping = stiffness + k * bed, c * bed
        free = self._free
        keys = np.repeat(np.linspace(0.0, self.track.length, n + 1), 2)[free]
        rail_dof = np.full(2 * n + 2, -1, dtype=np.int64)
        rail_dof[free] = np.arange(len(free))
        return add_supports(
            mass[free][:, free],
            None if damping is None else damping[free][:, free],
            stiffness[free][:, free],
            keys,
            self.track,
            [self._pad_row(first, last, rail_dof) for first, last in self.track.pad_footprints],
            self.direction,
        )

    def _pad_row(self, first: float, last: float, rail_dof: np.ndarray) -> PadRow:
        """Average deflection over a footprint, by exact integration of the shape functions."""
        (start, stop), (xi_start, xi_stop) = self._locate(np.array([first, last]))
        nodal = np.zeros(2 * self.n_elements + 2)
        if last == first:
            nodal[2 * start : 2 * start + 4] = self.element.deflection_shapes(xi_start)
        for e in range(start, stop + 1) if last > first else ():
            part = self.element.average_shapes(
                xi_start if e == start else 0.0, xi_stop if e == stop else 1.0
            )
            nodal[2 * e : 2 * e + 4] += part / (last - first)
        used = np.flatnonzero((nodal != 0.0) & (rail_dof >= 0))
        return PadRow(rail_dof[used], nodal[used])
