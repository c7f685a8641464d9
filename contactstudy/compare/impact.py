"""Impacts: their closed forms by a lumped model, and what is said of one in a signal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array


@dataclass(frozen=True)
class LumpedTrack:
    """An unsprung mass on a contact spring over a track that is one mass, spring and damper.

    Parameters
    ----------
    unsprung_mass : float
        m_u of the wheel in kg.
    contact_stiffness : float
        k_H, tangent at the static load, in N/m.
    track_mass, track_stiffness, track_damping : float
        m_t in kg, k_t in N/m and c_t in N s/m.
    """

    unsprung_mass: float
    contact_stiffness: float
    track_mass: float
    track_stiffness: float
    track_damping: float

    def p1(self, kink: float) -> float:
        """Dynamic part of the first peak of the contact force in N.

        ``P1 - P0 = 2 alpha v sqrt(k_H m_e/(1 + m_e/m_u))`` (H. H. Jenkins and others, Railway
        Eng. J. 3 (1974) 2): the wheel and the track's mass m_e = m_t set off towards each other
        with the velocity `kink` = 2 alpha v in m/s, before the track's spring and damper act. With
        the contact's compression d, ``d'' + k_H (1/m_u + 1/m_e) d = 0, d'(0) = 2 alpha v``.
        """
        m_u, m_e = self.unsprung_mass, self.track_mass
        return float(kink * np.sqrt(self.contact_stiffness * m_e / (1.0 + m_e / m_u)))

    def p2(self, kink: float) -> float:
        """Dynamic part of the second peak, of the force in the track's spring, in N.

        ``P2 - P0 = 2 alpha v sqrt(m_u/(m_u + m_t)) [1 - pi c_t/(4 sqrt(k_t (m_u + m_t)))]
        sqrt(k_t m_u)``: the contact is stiff, so both masses M = m_u + m_t move as one, from the
        momentum 2 alpha v m_u on: ``k_t z_max = k_t (2 alpha v m_u/M)/sqrt(k_t/M)``, and to first
        order in the damping ratio zeta the quarter of a period leaves ``1 - zeta pi/2`` of it,
        ``zeta = c_t/(2 sqrt(k_t M))``.
        """
        m_u, k_t = self.unsprung_mass, self.track_stiffness
        both = m_u + self.track_mass
        damped = 1.0 - np.pi * self.track_damping / (4.0 * np.sqrt(k_t * both))
        return float(kink * np.sqrt(m_u / both) * damped * np.sqrt(k_t * m_u))

    def response(self, times: Array, level: Array) -> Array:
        """Dynamic contact force and force in the track's spring, (2, n) in N, from rest.

        Parameters
        ----------
        times : ndarray (n,)
            Equally spaced, in s.
        level : ndarray (n,)
            r under the wheel in m, up; straight between the times.

        Notes
        -----
        ``m_u z_u'' = F, m_t z_t'' = -F - c_t z_t' - k_t z_t, F = k_H (z_t + r - z_u)``, exact by
        the matrix exponential of the states and of the input ``r, r'`` of a step (C. F. Van Loan,
        IEEE Trans. Autom. Control 23 (1978) 395).
        """
        from scipy.linalg import expm

        m_u, m_t, k_H = self.unsprung_mass, self.track_mass, self.contact_stiffness
        k_t, c_t = self.track_stiffness, self.track_damping
        # z_u, z_t, z_u', z_t', r, r'
        A = np.zeros((6, 6))
        A[0, 2] = A[1, 3] = A[4, 5] = 1.0
        force = k_H * np.array([-1.0, 1.0, 0.0, 0.0, 1.0, 0.0])
        A[2] = force / m_u
        A[3] = -force / m_t + np.array([0.0, -k_t / m_t, 0.0, -c_t / m_t, 0.0, 0.0])
        step = float(times[1] - times[0])
        move = expm(A * step)
        state, found = np.zeros(6), np.zeros((2, len(times)))
        for i, slope in enumerate(np.diff(level) / step):
            state[4:] = level[i] - level[0], slope
            state = move @ state
            found[:, i + 1] = force @ state, -k_t * state[1]
        return found


def first_peak(signal: Array) -> float:
    """Value of the first local maximum of a signal (n,) that starts at 0 and rises."""
    falls = np.flatnonzero(np.diff(signal) < 0.0)
    return float(signal[falls[0] if len(falls) else -1])


@dataclass(frozen=True)
class Impact:
    """What an impact does to the contact force.

    Attributes
    ----------
    lost_time, lost_length : float
        How long, and over what length, there is no contact, in s and m.
    impulse : float
        Time integral of what the force exceeds its static value by, in N s.
    """

    lost_time: float
    lost_length: float
    impulse: float


def impact(times: Array, positions: Array, force: Array, static: float) -> Impact:
    """Describe an impact by times (n,) in s, positions (n,) in m and contact force (n,) in N."""
    open_ = (force <= 0.0).astype(float)
    above = np.maximum(force - static, 0.0)
    return Impact(
        float(np.trapezoid(open_, times)),
        float(np.trapezoid(open_, positions)),
        float(np.trapezoid(above, times)),
    )
