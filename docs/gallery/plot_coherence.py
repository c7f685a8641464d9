"""
Coherence of two rails
======================

How much the irregularity of one rail says about the other's: long waves are those of the track,
short ones each rail's own. Two profiles are made with a given coherence, and it is estimated
from them again.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.signal import coherence

import contactstudy as cs
from contactstudy.irregularity.coherence import decaying_coherence, other_rail

target = decaying_coherence(3.0)  # exp(-3 m / wavelength)
spectrum = cs.spectrum("german_low")
right = cs.sample_profile(spectrum, seed=1, n_terms=12000, band=(0.2, 12.0), jitter=True)
left = other_rail(right, target, seed=1)

dx = 0.1
x = np.arange(0.0, 4000.0, dx)
wavenumber, found = coherence(right(x), left(x), fs=1 / dx, nperseg=1024)

figure, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5.5), layout="constrained")
upper.plot(x[:600], 1e3 * right(x[:600]), label="right rail")
upper.plot(x[:600], 1e3 * left(x[:600]), label="left rail")
upper.set(xlabel="Position (m)", ylabel="Level (mm)")
upper.legend()
inside = (wavenumber > 0.05) & (wavenumber < 1.8)
wavelength = 1 / wavenumber[inside]
lower.semilogx(wavelength, found[inside], lw=0.8, label="estimate")
lower.semilogx(wavelength, target(2 * np.pi / wavelength), "k--", label="exp(-3 m / wavelength)")
lower.set(xlabel="Wavelength (m)", ylabel="Coherence")
lower.legend()

# %%
# An estimate of n segments is too large by about :math:`(1-\gamma^2)^2/n` (G. C. Carter, Proc.
# IEEE 75 (1987) 236); here n is about 77.

expected = target(2 * np.pi / wavelength)
expected = expected + (1 - expected) ** 2 / (2 * x.size / 1024 - 1)
print(f"mean difference from the target {np.mean(found[inside] - expected):+.4f}")
assert abs(np.mean(found[inside] - expected)) < 0.01
