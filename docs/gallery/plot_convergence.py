"""
Order of convergence
====================

The same run with ever smaller time steps. Newmark's average acceleration is of second order
where the motion is smooth, so halving the step must divide the difference by four.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.compare.refinement import convergence

track, vehicle = cs.BeamTrack(cs.Track(length=12.0)), cs.wheel_column()
rail = cs.sample_profile(cs.spectrum("paper"), seed=1)
steps = 400e-6 / 2.0 ** np.arange(6)


def run(time_step):
    journey = cs.Journey(start=3.0, end=9.0, speed=50.0, time_step=time_step, fade_in=1.5)
    return cs.point_contact(track, vehicle, rail, journey, law=cs.LinearSpring(1.2e9))


runs = [run(step) for step in steps]
signals = {"wheel_displacement": "wheel displacement", "contact_force": "contact force"}
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
orders = {}
for name, label in signals.items():
    norms = [cs.compare_runs(r, runs[-1], start=4.5)[name]["relative_l2"] for r in runs[:-1]]
    axes.loglog(1e6 * steps[:-1], norms, "o-", label=label)
    fit = convergence(steps[:-1], norms, expected=2.0, scale=1.0)
    orders[name] = fit.order
    print(f"{label}: order {fit.order:.2f}, {fit.verdict}")
axes.loglog(1e6 * steps[:-1], 1e-4 * (steps[:-1] / steps[2]) ** 2, "k--", label="second order")
axes.set(xlabel="Time step (µs)", ylabel="Relative difference from the finest run")
axes.set_xticks(1e6 * steps[:-1], [f"{1e6 * step:g}" for step in steps[:-1]])
axes.set_xticks([], minor=True)
axes.legend()

# %%
# The finest run is no exact solution: differences from it shrink faster than errors do, and the
# last step's order is above 2. `[refine]` in a study file does this for any key, with an error
# band.

assert 1.9 < orders["wheel_displacement"] < 2.3
