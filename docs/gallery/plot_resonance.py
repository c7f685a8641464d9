"""
Resonance of a bridge under a train
===================================

Axles in pairs every 18 m run over a simply supported span of 20 m at many speeds. The deck
moves most where one load comes in each period of its first mode, and more than around it where
one comes in every second. The third resonance does not show: at nearly the same speed each load
leaves the span at rest.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.compare.bridge_codes import cancellation_speeds, resonance_speeds
from contactstudy.contact.laws import MovingForce
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import GivenDeck
from contactstudy.vehicle import AxleLoads

span, length = 20.0, 18.0
deck = GivenDeck(second_moment=1.0, mass_per_length=12e3, damping_ratio=0.01)
bridge = Bridge(spans=(span,), deck=deck, approach_before=12.0, approach_behind=12.0)
track = cs.Track(structure=bridge)
train = AxleLoads(axle_loads=(100e3,) * 16, axle_distances=((3.0, 15.0) * 8)[:-1]).vehicle()
middle = bridge.approach_before + span / 2


def largest(speed):
    """Largest deflection of mid-span (mm)."""
    end = bridge.length - train.wheel_offsets.min()
    journey = cs.Journey(0.0, end, speed, time_step=4e-3, fade_in=0.0, stations=(middle,))
    run = cs.point_contact(track, train, cs.SmoothRail(), journey, law=MovingForce())
    return 1e3 * float(np.abs(run.deck_displacement).max())


f1 = deck.frequency(span)
resonance, cancellation = resonance_speeds(f1, length, 3), cancellation_speeds(f1, span, 3)
speeds = np.linspace(0.85 * resonance[2], 1.12 * resonance[0], 31)
deflection = np.array([largest(v) for v in speeds])

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.plot(3.6 * speeds, deflection, "o-", markersize=3)
for i, v in enumerate(resonance, 1):
    axes.axvline(
        3.6 * v, color="C1", linestyle="--", label="" if i > 1 else "resonance, f₁ L_c / i"
    )
for i, v in enumerate(cancellation, 1):
    axes.axvline(3.6 * v, color="C2", linestyle=":", label="" if i > 1 else "cancellation")
axes.set(xlabel="Speed (km/h)", ylabel="Largest deflection of mid-span (mm)")
axes.legend()

highest = speeds[deflection.argmax()]
print(f"f₁ = {f1:.2f} Hz; f₁ L_c = {3.6 * resonance[0]:.0f} km/h,", end=" ")
print(f"largest deflection at {3.6 * highest:.0f} km/h")
assert abs(highest / resonance[0] - 1) < 0.04
