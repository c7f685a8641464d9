"""
Wheel flat
==========

A fresh flat of 40 mm rolls by on a smooth rail. At one speed: what the wheel feels, and the
contact force. Below: the largest force over speed.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.contact.filters import Trajectory
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.irregularity.defective import with_defects
from contactstudy.irregularity.flats import Flat

R, length, at = 0.43, 0.04, 7.0
track, vehicle = cs.BeamTrack(cs.Track(length=12.0), "timoshenko"), cs.wheel_column()
rail = with_defects(cs.SmoothRail(), wheel=Flat(at=at, length=length), radius=R)
hertz = hertz_contact(vehicle.static_loads[0], contact_modulus(), radius_x=R, radius_y=0.30)
law = cs.HertzSpring(hertz.stiffness)


def run(kmh):
    journey = cs.Journey(6.0, 8.0, kmh / 3.6, time_step=0.002 / kmh, fade_in=0.5)
    return cs.point_contact(track, vehicle, rail, journey, law=law, contact_filter=Trajectory(R))


figure, (felt, force, peak) = plt.subplots(3, 1, figsize=(7, 7), layout="constrained")
slow = run(60.0)
x = slow.position.values - at
height = Trajectory(R)(rail, slow.position.values)
felt.plot(1e3 * x, 1e6 * height)
felt.set(ylabel="Height of the wheel (µm)", xlim=(-60, 200))
for kmh in (60.0, 160.0):
    one = slow if kmh == 60.0 else run(kmh)
    force.plot(1e3 * (one.position - at), 1e-3 * one.contact_force, label=f"{kmh:.0f} km/h")
force.set(xlabel="Distance behind the flat (mm)", ylabel="Force (kN)", xlim=(-60, 200))
force.legend()
speeds = np.array([10, 20, 30, 50, 80, 120, 160, 220, 300])
largest = np.array([float(run(kmh).contact_force.max()) for kmh in speeds])
peak.plot(speeds, 1e-3 * largest, "o-")
peak.set(xlabel="Speed (km/h)", ylabel="Largest force (kN)")

# %%
# Seen from the axle the wheel turns over the edges of the flat: its height falls as :math:`-(l/2
# - |X|)^2/2R` to :math:`-l^2/8R` and rises again. At speed the wheel loses the rail: the force is
# zero for a while, and what it fell comes back as a blow.

closed = -(np.maximum(length / 2 - np.abs(x), 0.0) ** 2) / (2 * R)
error = np.abs(height - closed).max()
print(
    f"depth {1e6 * length**2 / (8 * R):.0f} µm; felt within {1e6 * error:.1f} µm of the closed form"
)
print(f"largest force {1e-3 * largest.max():.0f} kN at {speeds[largest.argmax()]} km/h")
assert error < 2e-6
