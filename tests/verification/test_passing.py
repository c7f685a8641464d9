"""Smooth rail: element-passing components stay below 0.1 % of the static load (both theories).

On discrete supports the harmonics of the sleeper passing are physical; on a uniform foundation
every component at the element length is the mesh's own.
"""

import pytest

from contactstudy.compare.passing import passing_amplitude
from contactstudy.contact.laws import HertzSpring
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import DiscreteSupports, Track, WinklerFoundation
from contactstudy.vehicle import wheel_column

HERTZ = HertzSpring(hertz_contact(60e3, contact_modulus(), 0.43, 0.30).stiffness)


def harmonics(support, theory, elements=4, compliance=True):
    """Amplitudes of wavelengths 0.6/1 ... 0.6/8 m in per cent of the static load."""
    vehicle = wheel_column()
    run = point_contact(
        BeamTrack(
            Track(support=support),
            theory=theory,
            elements_per_bay=elements,
            element_compliance=compliance,
        ),
        vehicle,
        SmoothRail(),
        Journey(),
        law=HERTZ,
    )
    settled = run.sel(time=slice(0.14, None))
    amplitudes = passing_amplitude(
        settled.position.values, settled.contact_force.values, 0.6, harmonics=8
    )
    return 100.0 * amplitudes / vehicle.static_loads[0]


@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
def test_element_passing_on_sleepers(theory):
    a, fine = harmonics(DiscreteSupports(), theory), harmonics(DiscreteSupports(), theory, 8)
    plain = harmonics(DiscreteSupports(), theory, compliance=False)
    print(
        f"{theory}: sleeper passing {a[0]:.3f} % (8 elements a bay {fine[0]:.3f} %); element"
        f" passing {a[3]:.4f} % and {a[7]:.4f} % (converged harmonics {fine[3]:.4f} %,"
        f" {fine[7]:.4f} %), without local compliance {plain[3]:.3f} % and {plain[7]:.3f} %"
    )
    assert a[3] < 0.1
    assert a[7] < 0.1
    assert a[0] == pytest.approx(fine[0], rel=0.01)


@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
def test_element_passing_on_a_uniform_foundation(theory):
    a = harmonics(WinklerFoundation(70e6, 6e4), theory)
    print(f"{theory}: element passing {a[3]:.5f} %, half of it {a[7]:.5f} %")
    assert a[3] < 0.03
    assert a[7] < 0.03
