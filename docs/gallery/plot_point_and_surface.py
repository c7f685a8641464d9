"""
Point and surface contact
=========================

One wheel, one track, one rough rail: surface contact of meshed bodies, and three point
contacts. The paper's scheme, as we read it, is an Euler beam with a large k_r.
"""

import matplotlib.pyplot as plt

import contactstudy as cs
from contactstudy.contact.press import PRESS_LOADS, tangent_stiffness
from contactstudy.solvers.at_rest import geometry_press

rail, vehicle = cs.sample_profile(cs.spectrum("paper"), seed=1), cs.wheel_column()
journey = cs.Journey(start=3.0, end=7.0, fade_in=1.0)
meshed, contact = cs.meshed_track(length=12.0), cs.SurfaceContact(cs.meshed_wheel())
static = vehicle.static_loads[0]
k_r = tangent_stiffness(geometry_press(meshed, contact, static * PRESS_LOADS), static)

surface = cs.surface_contact(meshed, contact, vehicle, rail, journey)
schemes = {
    "Euler, 1e11 N/m": (cs.BeamTrack(meshed.track), 1e11),
    "Euler, tangent": (cs.BeamTrack(meshed.track), k_r),
    "Timoshenko, tangent": (cs.BeamTrack(meshed.track, "timoshenko", element_compliance=True), k_r),
}
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.plot(surface.position, 1e-3 * surface.contact_force, "k", label="surface")
errors = []
for name, (track, stiffness) in schemes.items():
    point = cs.point_contact(track, vehicle, rail, journey, law=cs.LinearSpring(stiffness))
    axes.plot(point.position, 1e-3 * point.contact_force, "--", lw=1, label=name)
    error = cs.compare_runs(point, surface, start=4.0)["contact_force"]["relative_l2_dynamic"]
    errors.append(error)
    print(f"{name}: {100 * error:.1f} % of the dynamic part")
axes.set(xlabel="Position (m)", ylabel="Contact force (kN)", xlim=(4, 7))
axes.legend()

# %%
# Beam and solid rail share the track's parameters and nothing else, neither elements nor contact.
# That the best beam comes within a few per cent is a check of both.

assert errors[0] > errors[1] > errors[2] and errors[2] < 0.05
