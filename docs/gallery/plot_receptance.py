"""
Receptance of the track
=======================

How far the rail gives way under a harmonic unit force, in the middle of a bay and over a
sleeper. Near 1 kHz the rail vibrates between the sleepers as between pins: there is a peak in
mid-bay and a dip over the sleeper. The beam theory decides where it lies.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.track.receptance import receptance

frequency = np.geomspace(30.0, 2000.0, 300)
track = cs.Track(length=60.0)
middle, sleeper = 30.3, 30.0

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
peaks = {}
for theory, colour in (("euler", "C0"), ("timoshenko", "C1")):
    beam = cs.BeamTrack(track, theory, elements_per_bay=4, element_compliance=True)
    for x, dashes in ((middle, "-"), (sleeper, "--")):
        amplitude = np.abs(receptance(beam, x, frequency))
        label = f"{theory}, {'mid-bay' if x == middle else 'over a sleeper'}"
        axes.loglog(frequency, amplitude, colour + dashes, label=label)
        if x == middle:
            high = frequency > 600.0
            peaks[theory] = frequency[high][amplitude[high].argmax()]
axes.set(xlabel="Frequency (Hz)", ylabel="Receptance (m/N)")
axes.legend()

# %%
# An Euler beam on pins has its first frequency at (π/l)² √(EI/m) / 2π. The pads, which are no
# pins, leave the peak a little above it. Shear takes a quarter off.

rail = track.rail
pinned = (np.pi / 0.6) ** 2 * np.sqrt(rail.bending_stiffness("Z") / rail.mass_per_length)
print(f"Euler beam on pins: {pinned / (2 * np.pi):.0f} Hz")
print("peaks:", {theory: f"{f:.0f} Hz" for theory, f in peaks.items()})
assert abs(peaks["euler"] / (pinned / (2 * np.pi)) - 1) < 0.1
