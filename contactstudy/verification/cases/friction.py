"""Vertical part of the friction of a rolling patch, for balances that include it."""

from __future__ import annotations

import numpy as np

from contactstudy.geometry.pose import PlacedWheel
from contactstudy.halfspace.patch import Patch

_KALKER = 3.9


def vertical_friction(
    patch: Patch,
    wheel: PlacedWheel,
    speed: float,
    pitch_rate: float,
    friction: float,
    shear_modulus: float,
) -> float:
    """Upward friction force [N] on the wheel in steady rolling, without spin.

    The force opposes the rigid slip ``w`` of the wheel's surface over the rail; its size follows
    P. J. Vermeulen and K. L. Johnson (1964): with ``t = G a b C |w|/V / (3 mu N)`` it is
    ``mu N (1 - (1 - t)^3)``, and ``mu N`` for t > 1. C = 3.9 is the mean of Kalker's C_11 and C_22
    for a circular patch and nu = 0.28.

    Parameters
    ----------
    speed : float
        V, of the axle along the track [m/s].
    pitch_rate : float
        Of the wheel about its axle, positive rolling forwards [rad/s].
    friction, shear_modulus : float
        mu, and G [Pa].
    """
    s = np.array([patch.wheel_s])
    local = wheel.radius - float(wheel.curve.point(s)[0, 1])
    angle = np.arcsin(float(wheel.locus(s)[0]) / local)
    # forward rolling turns the bottom backwards
    turning = -pitch_rate * local * np.array([np.cos(angle), 0.0, np.sin(angle)])
    slip = np.array([speed, 0.0, 0.0]) + wheel.pose.to_track @ turning
    normal = np.array([0.0, -np.sin(patch.centre.angle), np.cos(patch.centre.angle)])
    slip -= normal * float(normal @ slip)
    size = float(np.linalg.norm(slip))
    limit = friction * patch.normal_force
    if size == 0.0 or limit == 0.0:
        return 0.0
    stiff = shear_modulus * patch.along * patch.across * _KALKER * size / speed
    share = 1.0 - (1.0 - min(stiff / (3.0 * limit), 1.0)) ** 3
    return float(-limit * share * slip[2] / size)
