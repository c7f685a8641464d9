"""A beam on its supports as the one mass, spring and damper of the P1 and P2 formulas."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from contactstudy.compare.impact import LumpedTrack
from contactstudy.track.model import Ballast, DiscreteSupports, Track, WinklerFoundation


def bed(track: Track) -> tuple[float, float, float]:
    """Mass, stiffness and damping per length of a rail with its supports [kg/m, N/m^2, N s/m^2].

    Pad and ballast in series, which hardly moves the sleepers against the rail below some 100 Hz:
    ``1/k = 1/k_p + 1/k_b``, and the dampers share the work in the ratio of the squares of their
    strokes. A slab is taken as at rest.
    """
    mass, support = track.rail.mass_per_length, track.support
    if isinstance(support, WinklerFoundation):
        return mass, *support.values()
    assert isinstance(support, DiscreteSupports)
    k, c = support.pad_stiffness, support.pad_damping
    if isinstance(support.layer, Ballast):
        below, damper = support.layer.stiffness, support.layer.damping
        c = (c * below**2 + damper * k**2) / (k + below) ** 2
        k = k * below / (k + below)
        mass += support.sleeper_mass / support.spacing
    return mass, k / support.spacing, c / support.spacing


def for_p2(track: Track, unsprung_mass: float, contact_stiffness: float) -> LumpedTrack:
    """Equal energies in the static deflection of an infinite beam on the bed.

    With ``w = exp(-b|x|) (cos bx + sin b|x|)``, ``b = (k/4EI)^(1/4)`` and its integral of squares
    3/(2b): ``m_t = 3m/(2b)``, ``c_t = 3c/(2b)``; the stiffness is ``k_t = 2k/b`` (M. Hetenyi, Beams
    on Elastic Foundation (1946)).
    """
    m, k, c = bed(track)
    b = (k / (4.0 * track.rail.bending_stiffness())) ** 0.25
    share = 3.0 / (2.0 * b)
    return LumpedTrack(unsprung_mass, contact_stiffness, share * m, 2.0 * k / b, share * c)


def for_p1(track: Track, unsprung_mass: float, contact_stiffness: float) -> LumpedTrack:
    """The rail alone as the mass of equal receptance at the frequency of P1.

    Of an infinite Euler beam ``|u/F| = sqrt(2)/(4 EI q^3)``, ``q = (m w^2/EI)^(1/4)``, at
    ``w^2 = k_H (1/m_u + 1/m_e)``. A beam sends its energy away where a mass keeps it, so P1 is an
    estimate.
    """
    EI, m = track.rail.bending_stiffness(), track.rail.mass_per_length
    found = for_p2(track, unsprung_mass, contact_stiffness)
    for _ in range(100):
        square = contact_stiffness * (1.0 / unsprung_mass + 1.0 / found.track_mass)
        q = (m * square / EI) ** 0.25
        found = replace(found, track_mass=float(4.0 * EI * q**3 / (np.sqrt(2.0) * square)))
    return found
