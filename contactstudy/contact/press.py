"""Static press of two bodies: force over approach, tangent stiffness, contact ellipse."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.augmented import Enforcement, Penalty, PointProblem
from contactstudy.contact.complementarity import PressedForces
from contactstudy.exceptions import InputError
from contactstudy.geometry.points import ContactPoints

DEFAULT_LAW = Penalty()
PRESS_LOADS = np.linspace(0.25, 2.0, 8)
"""Loads of a static press from which a stiffness is taken, in static wheel loads."""


@dataclass(frozen=True)
class PressCurve:
    """Force over approach of a static press.

    Attributes
    ----------
    force, approach, stiffness : ndarray (k,)
        Resultants in N, approaches in m, tangents dF/d(approach) in N/m.
    penetration : ndarray (k,)
        Largest overlap of the bodies left by the enforcement, m.
    solutions : tuple of PressedForces
        Forces at the contact points for every load.
    gaps : tuple of ndarray (n,)
        Gaps of the deformed bodies there in m, minus the overlap in contact.
    """

    force: Array
    approach: Array
    stiffness: Array
    penetration: Array
    solutions: tuple[PressedForces, ...]
    gaps: tuple[Array, ...]

    @property
    def exponent(self) -> float:
        """Least-squares slope of log F over log approach (Hertz: 1.5)."""
        return float(np.polyfit(np.log(self.approach), np.log(self.force), 1)[0])


def press_stiffness(curve: PressCurve, load: float) -> tuple[float, float]:
    """Tangent dF/d(approach) and secant F/approach [N/m] at a load [N], free of the mesh's steps.

    As the patch grows points enter it one after the other: the computed curve is a polygon
    whose own slope jumps by a few percent. So the curve ``approach = c1 F^(2/3) + c2 F``,
    Hertz's local part and a linear part for the bodies at large, is fitted first.

    Raises
    ------
    InputError
        If the curve has fewer than four loads or they do not enclose the load.
    """
    F = curve.force
    if len(F) < 4 or not F.min() <= load <= F.max():
        raise InputError(
            f"contact stiffness at {load} N: the press curve must have four loads or more around "
            f"it (it has {len(F)} from {F.min():.6g} to {F.max():.6g} N)"
        )
    basis = np.stack([F ** (2 / 3), F], axis=1)
    c1, c2 = np.linalg.lstsq(basis, curve.approach, rcond=None)[0]
    # approach/F = c1 F^(-1/3) + c2,  d(approach)/dF = 2/3 c1 F^(-1/3) + c2
    local = c1 * load ** (-1 / 3)
    return float(1.0 / (2 / 3 * local + c2)), float(1.0 / (local + c2))


def tangent_stiffness(curve: PressCurve, load: float) -> float:
    """The tangent alone [N/m]."""
    return press_stiffness(curve, load)[0]


def press_curve(
    points: ContactPoints,
    flexibility: Array,
    loads: Array,
    law: Enforcement = DEFAULT_LAW,
    reference: Array | None = None,
) -> PressCurve:
    """Press two bodies together with given forces.

    Parameters
    ----------
    flexibility : ndarray (n, n)
        Growth of the gap at the points (along the normal) in m for unit normal forces in N,
        of both bodies together.
    loads : ndarray (k,)
        Vertical resultants in N, positive.
    reference : ndarray (n,), optional
        Downward displacement in m/N of a reference on the lower body (the rail's centre line)
        for unit forces at the points: the approach is then measured from there instead of from
        the point to which the flexibility is fixed.
    """
    compliance = law.compliance(points.area)
    M = flexibility + np.diag(compliance)
    normal = points.normal_z
    approach, stiffness, penetration, solutions, gaps = [], [], [], [], []
    last: PressedForces | None = None
    for load in np.asarray(loads, dtype=float):
        start, guess, first = (
            (np.zeros(len(normal)), None, None)
            if last is None
            else (last.forces, last.active, last.approach)
        )
        problem = PointProblem(M, points.gap, compliance, start, guess)
        last, overlap = law.press(problem, normal, float(load), first)
        delta, softness = last.approach, 1.0 / last.stiffness
        if reference is not None:
            # d lam/dF = M_AA^-1 n_A / (n_A^T M_AA^-1 n_A)
            active = last.active
            rate = np.linalg.solve(M[np.ix_(active, active)], normal[active]) / last.stiffness
            delta -= float(reference @ last.forces)
            softness -= float(reference[active] @ rate)
        approach.append(delta)
        stiffness.append(1.0 / softness)
        penetration.append(float(overlap.max()))
        solutions.append(last)
        gaps.append(points.gap + flexibility @ last.forces - last.approach * normal)
    return PressCurve(
        np.asarray(loads, dtype=float),
        np.array(approach),
        np.array(stiffness),
        np.array(penetration),
        tuple(solutions),
        tuple(gaps),
    )
