"""Receptance of a discretised track in the frequency domain."""

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.exceptions import NumericalError
from contactstudy.track.discrete import DiscreteTrack


def receptance(
    track: DiscreteTrack, x: float, frequency: Array, at: float | None = None
) -> np.ndarray:
    """Displacement per harmonic unit force on the rail at x [m], exp(+i omega t), (nf,) [m/N].

    (K + i omega C - omega^2 M) u = N(x)^T; the receptance is N(at) u. Multiply by i omega for
    the mobility.

    Parameters
    ----------
    at : float, optional
        Where the displacement is taken [m]; under the force (with the local compliance) when
        not given.

    Raises
    ------
    NumericalError
        At an undamped resonance.
    """
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    n = track.mass.shape[0]
    force, response = np.zeros(n), np.zeros(n)
    for row, position in ((force, x), (response, x if at is None else at)):
        dofs, weights = track.rail_rows(np.array([position]))
        np.add.at(row, dofs[0], weights[0])
    local = float(track.local_compliance(np.array([x]))[0]) if at is None else 0.0
    K, C, M = track.stiffness, track.damping, track.mass
    result = np.empty(len(frequency), dtype=complex)
    for i, omega in enumerate(2.0 * np.pi * frequency):
        dynamic = sp.coo_array(K + 1j * omega * C - omega**2 * M)
        rows, columns = dynamic.coords
        bandwidth = int(np.abs(rows - columns).max(initial=0))
        band = np.zeros((2 * bandwidth + 1, n), dtype=complex)
        band[bandwidth + rows - columns, columns] = dynamic.data
        try:
            u = scipy.linalg.solve_banded((bandwidth, bandwidth), band, force, overwrite_ab=True)
        except np.linalg.LinAlgError as error:
            raise NumericalError(
                f"the track has an undamped resonance at {frequency[i]:g} Hz"
            ) from error
        result[i] = response @ u + local
    return result
