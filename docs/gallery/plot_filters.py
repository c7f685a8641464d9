"""
Effective roughness
===================

What a contact makes of a rough rail before its law acts. A patch takes the mean: it leaves
:math:`\\sin(ka)/(ka)` of a wave of wavenumber k, a being half the patch's length. A round wheel
bridges dips.
"""

import matplotlib.pyplot as plt
import numpy as np

from contactstudy.contact.filters import PatchMean, Trajectory
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact

a = hertz_contact(67.4e3, contact_modulus(), radius_x=0.43, radius_y=0.30).semi_axis_x
patch, wheel = PatchMean.uniform(a), Trajectory(0.43)
wavelength = np.geomspace(0.008, 0.3, 60)


def left(contact_filter, amplitude):
    """Half of the height from trough to crest that a wheel feels of each wave."""
    heights = []
    for length in wavelength:
        x = np.linspace(0.0, length, 201)
        felt = contact_filter(lambda X, w=length: amplitude * np.cos(2 * np.pi * X / w), x)
        heights.append(0.5 * np.ptp(felt) / amplitude)
    return np.array(heights)


figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.semilogx(1e3 * wavelength, left(patch, 1e-6), label=f"patch, a = {1e3 * a:.1f} mm")
for amplitude in (1e-6, 10e-6, 100e-6):
    label = f"round wheel, {1e6 * amplitude:.0f} µm"
    axes.semilogx(1e3 * wavelength, left(wheel, amplitude), "--", label=label)
axes.set(xlabel="Wavelength (mm)", ylabel="Part of the amplitude left")
axes.legend()

# %%
# The patch against its closed form. The wheel follows a wave whole as long as the troughs are
# less curved than it is, :math:`A k^2 < 1/R`:

k = 2 * np.pi / wavelength
error = np.abs(left(patch, 1e-6) - np.abs(np.sin(k * a) / (k * a))).max()
follows, bridges = (10e-6 * k**2 * 0.43 < 0.9), (10e-6 * k**2 * 0.43 > 1.2)
short = left(wheel, 10e-6)
print(f"patch: {error:.1e} from the closed form")
print(f"wheel: 10 µm are followed from {2e3 * np.pi * (10e-6 * 0.43) ** 0.5:.1f} mm up")
assert error < 1e-6
assert np.allclose(short[follows], 1.0, atol=1e-4) and (short[bridges] < 0.999).all()
