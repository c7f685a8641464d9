"""Pinned-pinned frequency of UIC60 on sleepers 0.6 m apart: Euler 1422.4, Timoshenko 1058.3 Hz."""

import math

import numpy as np
import pytest
import scipy.linalg

from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import GivenRail, Track

# the source does not state the area; steel of 7850 kg/m^3 makes it 76.9 cm^2
EI, MASS, DENSITY, SPACING, KAPPA, SHEAR = 6.4155e6, 60.367, 7850.0, 0.6, 0.4, 77e9
AREA = MASS / DENSITY


def exact(theory):
    """First frequency of the simply supported beam [Hz]; Timoshenko's with rotary inertia."""
    q = math.pi / SPACING
    if theory == "euler":
        return q**2 * math.sqrt(EI / MASS) / (2 * math.pi)
    inertia = DENSITY * EI / 210e9
    gak = KAPPA * SHEAR * AREA
    # (gak q^2 - m w^2)(EI q^2 + gak - rho I w^2) = (gak q)^2
    roots = np.roots(
        [MASS * inertia, -(gak * q**2 * inertia + MASS * (EI * q**2 + gak)), gak * EI * q**4]
    )
    return math.sqrt(min(roots)) / (2 * math.pi)


def computed(theory, elements, compliance):
    rail = GivenRail(
        EI=EI,
        mass=MASS,
        area=AREA,
        shear_coefficient=KAPPA,
        poisson_ratio=210e9 / (2 * SHEAR) - 1,
    )
    track = Track(rail, support=None, length=SPACING, ends="pinned")
    beam = BeamTrack(track, theory, elements, compliance)
    squared = scipy.linalg.eigh(
        beam.stiffness.toarray(), beam.mass.toarray(), eigvals_only=True, subset_by_index=[0, 0]
    )
    return math.sqrt(squared[0]) / (2 * math.pi)


@pytest.mark.parametrize(("theory", "published"), [("euler", 1422.4), ("timoshenko", 1058.3)])
def test_pinned_pinned_frequency(theory, published):
    fine = computed(theory, 24, True)
    print(f"{theory}: published {published}, exact {exact(theory):.2f}, computed {fine:.2f} Hz")
    assert fine == pytest.approx(published, rel=1e-4)
    assert fine == pytest.approx(exact(theory), rel=1e-5)


def test_convergence_of_the_timoshenko_element():
    # the nodal shapes alone converge with h^2; the inner dofs make 4 elements a bay enough
    errors = [computed("timoshenko", n, False) / exact("timoshenko") - 1 for n in (6, 12, 24)]
    coarse = [computed("timoshenko", 4, on) / exact("timoshenko") - 1 for on in (False, True)]
    print(f"error at 4 elements a bay: {coarse[0]:.2%}, with inner dofs {coarse[1]:.3%}")
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.05)
    assert math.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.05)
    assert abs(coarse[1]) < 3e-4
