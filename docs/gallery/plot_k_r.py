"""
Which constant replaces Hertz's law
===================================

A linear spring k_r from a fifth of Hertz's tangent to a hundred times it, against Hertz's law
on the same beam. The best one is the tangent at the static load, 1.5 times the secant of the
paper's eq. (7).
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact

vehicle, track = cs.wheel_column(), cs.BeamTrack(cs.Track(length=18.0))
rail = cs.sample_profile(cs.spectrum("paper"), seed=1)
journey = cs.Journey(start=3.0, end=15.0, speed=200 / 3.6, fade_in=1.5)
hertz = hertz_contact(vehicle.static_loads[0], contact_modulus(), radius_x=0.43, radius_y=0.30)
tangent = hertz.tangent_stiffness


def run(law):
    return cs.point_contact(track, vehicle, rail, journey, law=law)


def error(run, reference):
    return cs.compare_runs(run, reference, start=4.5)["contact_force"]["relative_l2_dynamic"]


reference = run(cs.HertzSpring(hertz.stiffness))
factors = np.r_[np.geomspace(0.2, 0.8, 6), np.linspace(0.9, 1.1, 5), np.geomspace(1.25, 100, 9)]
errors = np.array([error(run(cs.LinearSpring(f * tangent)), reference) for f in factors])

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.loglog(factors, 100 * errors, "o-")
axes.axvline(2 / 3, color="C1", linestyle="--", label="secant")
axes.axvline(1.0, color="C2", linestyle="--", label="tangent")
axes.set(xlabel="k_r over Hertz's tangent", ylabel="Error of the dynamic part (%)")
axes.legend()

# %%
# The best constant is found without knowing Hertz's tangent. What it leaves is of second order in
# the dynamic force, and a considerably large k_r costs a constant error.

best = factors[errors.argmin()]
print(f"best k_r: {best:.2f} x tangent, error {100 * errors.min():.2f} %")
secant, large = np.interp(2 / 3, factors, errors), errors[-1]
print(f"secant: {100 * secant:.1f} %, 100 x tangent: {100 * large:.1f} %")
assert abs(best - 1) < 0.06
