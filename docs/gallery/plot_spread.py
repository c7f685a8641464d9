"""
Spread over samples
===================

One profile is one sample of a spectrum. Sixteen samples give the spread of the force, and
random vibration its expected value: with the receptances of rail, wheel and contact the density
of the force is :math:`S_F = S_r / |\\alpha_r + \\alpha_w + 1/k_r|^2`.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.track.model import WinklerFoundation

speed, band, k_r = 160 / 3.6, (0.6, 20.0), 1.2e9
vehicle, bed = cs.wheel_column(), WinklerFoundation(stiffness=80e6, damping=60e3)
track = cs.BeamTrack(cs.Track(support=bed, length=72.0))
journey = cs.Journey(start=6.0, end=66.0, speed=speed, time_step=2e-4, fade_in=3.0)
spectrum = cs.spectrum("paper")


def deviation(seed):
    rail = cs.sample_profile(spectrum, seed, n_terms=400, band=band, jitter=True)
    run = cs.point_contact(track, vehicle, rail, journey, law=cs.LinearSpring(k_r))
    return float(run.contact_force.values[run.position > 12.0].std())


found = np.array([deviation(seed) for seed in range(1, 17)])

# %%
# The closed form: an infinite beam on its bed, and the vehicle's matrices, at the frequencies
# that the waves have at this speed.

w = np.linspace(*band, 4000)
omega, rail = w * speed, track.track.rail
EI, m = rail.bending_stiffness("Z"), rail.mass_per_length
k = ((m * omega**2 - 80e6 - 1j * omega * 60e3) / EI) ** 0.25
of_rail = -(1 + 1j) / (4 * EI * k**3)
dynamic = vehicle.stiffness + 1j * omega[:, None, None] * vehicle.damping
dynamic = dynamic - omega[:, None, None] ** 2 * vehicle.mass
of_wheel = np.linalg.inv(dynamic)[:, 0, 0]
density = spectrum(w) / np.abs(of_rail + of_wheel + 1 / k_r) ** 2
expected = np.sqrt(2 * np.trapezoid(density, w))

figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
axes.plot(np.arange(1, 17), 1e-3 * found, "o", label="samples")
axes.axhline(1e-3 * np.sqrt(np.mean(found**2)), color="C0", label="of all samples")
axes.axhline(1e-3 * expected, color="C1", linestyle="--", label="closed form")
axes.set(xlabel="Seed", ylabel="Standard deviation of the force (kN)")
axes.legend()
of_all = np.sqrt(np.mean(found**2))
print(f"closed form {1e-3 * expected:.3f} kN, sixteen samples {1e-3 * of_all:.3f} kN,", end=" ")
print(f"single ones {1e-3 * found.min():.2f} to {1e-3 * found.max():.2f} kN")
assert abs(of_all / expected - 1) < 0.06
