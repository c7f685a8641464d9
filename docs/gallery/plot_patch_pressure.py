"""
Pressure in the contact patch
=============================

The pressure under the static load on the mesh of surface contact, 2 mm wide at the running
surface, and Hertz's ellipse over it.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.solvers.at_rest import geometry_press

static = cs.wheel_column().static_loads[0]
contact = cs.SurfaceContact(cs.meshed_wheel())
press = geometry_press(cs.meshed_track(length=12.0), contact, static * np.array([0.5, 1.0]))
points = contact.points
nodal = points.nodal_pressure(press.solutions[1].forces).reshape(len(points.wheel_x), -1)
hertz = hertz_contact(static, contact_modulus(), radius_x=0.43, radius_y=0.30)

figure, (plan, cut) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
x, y = 1e3 * points.wheel_x, 1e3 * points.wheel_y  # half of the patch is meshed
shown = plan.pcolormesh(x, np.r_[-y[:0:-1], y], 1e-6 * np.c_[nodal[:, :0:-1], nodal].T)
figure.colorbar(shown, label="Pressure (MPa)", location="top")
angle = np.linspace(0, 2 * np.pi, 200)
ellipse = hertz.semi_axis_x * np.cos(angle), hertz.semi_axis_y * np.sin(angle)
plan.plot(1e3 * ellipse[0], 1e3 * ellipse[1], "w--")
plan.set(xlabel="Along the rail (mm)", ylabel="Across (mm)", aspect="equal")

fine = np.linspace(points.wheel_x[0], points.wheel_x[-1], 300)
cut.plot(x, 1e-6 * nodal[:, 0], "o", label="meshed bodies")
cut.plot(1e3 * fine, 1e-6 * hertz.pressure(fine, 0 * fine), "--", label="Hertz")
cut.set(xlabel="Along the rail (mm)", ylabel="Pressure (MPa)", ylim=(0, 1500))
cut.legend()

# %%
# The patch's second moments give its semi-axes, and with the load the peak of the ellipse. Two
# elements of 2 mm lie across half of it: single nodes scatter, moments do not.

axes = points.semi_axes(press.solutions[1].forces)
a, b = axes["semi_axis_along"], axes["semi_axis_across"]
peak = 1.5 * static / (np.pi * a * b)
print(f"semi-axes {1e3 * a:.2f} and {1e3 * b:.2f} mm, peak {1e-6 * peak:.0f} MPa")
print(f"Hertz     {1e3 * hertz.semi_axis_x:.2f} and {1e3 * hertz.semi_axis_y:.2f} mm,", end=" ")
print(f"peak {1e-6 * hertz.peak_pressure:.0f} MPa")
assert abs(a / hertz.semi_axis_x - 1) < 0.05 and abs(b / hertz.semi_axis_y - 1) < 0.05
