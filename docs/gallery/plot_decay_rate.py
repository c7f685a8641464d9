"""
Decay rate of the track
=======================

How fast vibration dies out along the rail in dB/m, as EN 15461 takes it from transfer functions
to points along the rail. Where it is small a long piece of rail radiates noise.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.track.model import DiscreteSupports, WinklerFoundation
from contactstudy.track.receptance import receptance

frequency = 1000.0 * 10 ** np.arange(-1.0, 0.35, 0.1)  # third octaves, 100 Hz to 2 kHz
distance = np.arange(0.0, 24.0, 0.15)


def decay_rate(transfer):
    """4.343 / (sum of |A(x)|^2/|A(0)|^2 dx) in dB/m, A (distances, frequencies)."""
    dx = np.r_[0.075, np.full(distance.size - 1, 0.15)]
    return 4.343 / (dx @ np.abs(transfer / transfer[0]) ** 2)


def computed(track, theory):
    beam = cs.BeamTrack(track, theory, elements_per_bay=4, element_compliance=True)
    return np.array([receptance(beam, 18.0, frequency, at=18.0 + d) for d in distance])


figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for stiffness in (65e6, 400e6):
    track = cs.Track(support=DiscreteSupports(pad_stiffness=stiffness), length=60.0)
    rate = decay_rate(computed(track, "timoshenko"))
    axes.semilogx(frequency, rate, "o-", label=f"pads of {1e-6 * stiffness:.0f} MN/m")
axes.set(xlabel="Frequency (Hz)", ylabel="Decay rate (dB/m)")
axes.legend()

# %%
# The same sum over the closed form of an infinite Euler beam on a bed, :math:`A = -i (e^{-ikx} -
# i e^{-kx}) / (4 EI k^3)`, with :math:`EI k^4 = m\omega^2 - s - i\omega c`:

bed = cs.Track(support=WinklerFoundation(stiffness=100e6, damping=120e3), length=60.0)
rail, omega = bed.rail, 2 * np.pi * frequency
EI, m = rail.bending_stiffness("Z"), rail.mass_per_length
k = ((m * omega**2 - 100e6 - 1j * omega * 120e3) / EI + 0j) ** 0.25
x = distance[:, None]
closed = decay_rate(-1j * (np.exp(-1j * k * x) - 1j * np.exp(-k * x)) / (4 * EI * k**3))
error = np.abs(decay_rate(computed(bed, "euler")) / closed - 1)
print(f"largest difference from the closed form: {100 * error.max():.2f} %")
assert error.max() < 0.01
