"""
Force over approach of the press
================================

The meshed wheel pressed on the meshed rail, beside Hertz's law of two half-spaces. Rail head
and wheel are no half-spaces: a part of the approach grows in proportion to the force. So the
tangent, the k_r that fits, is smaller than Hertz's.
"""

import matplotlib.pyplot as plt
import numpy as np

import contactstudy as cs
from contactstudy.contact.press import press_stiffness
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.solvers.at_rest import geometry_press

loads = np.linspace(15e3, 135e3, 9)
press = geometry_press(cs.meshed_track(length=12.0), cs.SurfaceContact(cs.meshed_wheel()), loads)
hertz = [hertz_contact(F, contact_modulus(), radius_x=0.43, radius_y=0.30) for F in loads]

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.plot(1e6 * press.approach, 1e-3 * loads, "o-", label="meshed bodies")
axes.plot([1e6 * h.approach for h in hertz], 1e-3 * loads, "--", label="Hertz")
axes.set(xlabel="Approach (µm)", ylabel="Force (kN)", xlim=0, ylim=0)
axes.legend()

static = cs.wheel_column().static_loads[0]
tangent, secant = press_stiffness(press, static)
print(f"tangent at {1e-3 * static:.1f} kN: {1e-9 * tangent:.3f} GN/m, secant {1e-9 * secant:.3f}")

# %%
# Take the approach apart, :math:`\delta = c_1 F^{2/3} + c_2 F`: the first part must be Hertz's,
# whose :math:`c_1` is :math:`k_H^{-2/3}`.

c1, c2 = np.linalg.lstsq(np.column_stack([loads ** (2 / 3), loads]), press.approach)[0]
of_hertz = hertz[0].stiffness ** (-2 / 3)
print(f"local part {c1 / of_hertz:.3f} of Hertz's; the rest is a spring of {1e-9 / c2:.1f} GN/m")
assert abs(c1 / of_hertz - 1) < 0.03
