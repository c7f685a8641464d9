"""Receptance and decay rate of a discretised track in the frequency domain."""

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
    return np.array([response @ _motion(track, force, f) + local for f in frequency])


def decay_rate(
    track: DiscreteTrack, x: float, frequency: Array, reach: float, spacing: float = 0.05
) -> Array:
    """Decay rate of vibration along the rail from X = x to x + reach [m], (nf,) [dB/m].

    EN 15461: ``4.343/sum_n |A(x_n)/A(0)|^2 dx_n``, 10/ln 10 over the integral of the squared
    response, which is the decay rate of an exponential. `spacing` [m] is that of the points.

    Raises
    ------
    NumericalError
        At an undamped resonance.
    """
    at = x + np.linspace(0.0, reach, max(2, round(reach / spacing)) + 1)
    dofs, weights = track.rail_rows(at)
    local = float(track.local_compliance(at[:1])[0])
    force = np.zeros(track.mass.shape[0])
    np.add.at(force, dofs[0], weights[0])
    found = []
    for one in np.atleast_1d(np.asarray(frequency, dtype=float)):
        response = np.sum(weights * _motion(track, force, one)[dofs], axis=1)
        response[0] += local
        squared = np.abs(response / response[0]) ** 2
        found.append(10.0 / np.log(10.0) / np.trapezoid(squared, at))
    return np.array(found)


def _motion(track: DiscreteTrack, force: Array, frequency: float) -> np.ndarray:
    """Complex displacements (n,) under a harmonic force (n,) at a frequency [Hz]."""
    omega = 2.0 * np.pi * frequency
    damping = track.damping
    if (G := track.dampers) is not None:
        damping = damping + G.T @ G
    dynamic = sp.coo_array(track.stiffness + 1j * omega * damping - omega**2 * track.mass)
    rows, columns = dynamic.coords
    bandwidth = int(np.abs(rows - columns).max(initial=0))
    band = np.zeros((2 * bandwidth + 1, len(force)), dtype=complex)
    band[bandwidth + rows - columns, columns] = dynamic.data
    try:
        return np.asarray(
            scipy.linalg.solve_banded((bandwidth, bandwidth), band, force, overwrite_ab=True)
        )
    except np.linalg.LinAlgError as error:
        raise NumericalError(f"the track has an undamped resonance at {frequency:g} Hz") from error
