"""
A spectrum of one's own
=======================

A power spectral density as a formula, a profile that has it, and Welch's estimate of the
profile.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.irregularity.estimate import spectral_estimate
from contactstudy.irregularity.psd import Convention, Spectrum

# one-sided, of the wavenumber in 1/m, in mm^2 m
mine = Spectrum(
    "mine", lambda n: 3e-6 / (1.0 + (n / 4.0) ** 3), Convention("one", "1/m", square=1e-6)
)
band = (2 * np.pi / 1.0, 2 * np.pi / 0.02)  # waves of 20 mm to 1 m, in rad/m
profile = cs.sample_profile(mine, seed=1, n_terms=8000, band=band, jitter=True)

x = np.arange(0.0, 120.0, 0.002)
level = profile(x)
estimate = spectral_estimate(level, 0.002, segment_length=4.0)

figure, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5.5), layout="constrained")
upper.plot(x[:1000], 1e6 * level[:1000])
upper.set(xlabel="Position (m)", ylabel="Level (µm)")
inside = (estimate.wavenumber > 1.05 * band[0]) & (estimate.wavenumber < 0.95 * band[1])
w = estimate.wavenumber[inside]
lower.loglog(w, estimate.density[inside], lw=0.7, label="estimate of the profile")
lower.loglog(w, mine(w), "--", label="formula")
lower.set(xlabel="Wavenumber (rad/m)", ylabel="Density, two-sided (m²/(rad/m))")
lower.legend()

# %%
# Inside, all spectra are two-sided in rad/m; `Convention` says how the formula is meant, and
# converts. The variance must be the integral of the formula, and the estimate must lie about it.

variance = mine.variance(*band)
ratio = np.mean(estimate.density[inside] / mine(w))
print(f"standard deviation {1e6 * level.std():.2f} µm, of the formula {1e6 * variance**0.5:.2f} µm")
print(f"estimate over formula {ratio:.3f} on average of {estimate.n_segments} segments")
assert abs(level.var() / variance - 1) < 0.05 and abs(ratio - 1) < 0.03
