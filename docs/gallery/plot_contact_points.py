"""
Where wheel and rail touch
==========================

Contact position on the rail and rolling radius of both wheels, over the lateral shift of the
wheelset: the worn-in profile S1002 and a cone of 1:20 on rails 60E1 inclined 1:40. The
difference of the radii over the shift steers the wheelset; S1002 jumps to the gauge corner.
"""

import matplotlib.pyplot as plt
import numpy as np

from contactstudy.geometry.wheelset import Wheelset
from contactstudy.profiles.named import rail_curve, wheel_curve

shift = np.arange(0.0, 6.01e-3, 0.5e-3)


def touches(profile):
    """Contact position on the rail (mm) and rolling radius (mm) of the right and left wheel."""
    wheelset = Wheelset(wheel=wheel_curve(profile), rail=rail_curve("60E1"), radius=0.46)
    found = []
    for y in shift:
        roll = wheelset.rest_roll(y, 0.0)
        touch = [wheelset.geometry(side, y, 0.0, roll).touch for side in ("right", "left")]
        found.append([(t.arc, 0.46 - wheelset.wheel.point(t.wheel_s)[1]) for t in touch])
    return 1e3 * np.array(found)


figure, (place, radius) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
difference = {}
for profile, marker in (("S1002", "o-"), ("cone", "s--")):
    found = touches(profile)
    difference[profile] = found[:, 0, 1] - found[:, 1, 1]
    place.plot(1e3 * shift, found[:, 0, 0], marker, markersize=3, label=f"{profile}, right wheel")
    radius.plot(1e3 * shift, difference[profile], marker, markersize=3, label=profile)
place.set(xlabel="Shift to the right (mm)", ylabel="From the rail's crown (mm)")
radius.set(xlabel="Shift to the right (mm)", ylabel="Right less left radius (mm)")
place.legend()
radius.legend()

# %%
# A cone of slope δ on rails with a crown of radius R steers a wheelset of radius r, whose contacts
# stand 2l apart, with the conicity :math:`\delta (l + R\delta)/(l - r\delta)` (A. H. Wickens,
# Fundamentals of Rail Vehicle Dynamics (2003)): a little more than its slope.

conicity = difference["cone"][1:] / (2e3 * shift[1:])
half, slope = 0.75 - 4.5e-3, 1 / 20  # contact of a centred cone lies 4.5 mm inside the tape circle
expected = slope * (half + 0.3 * slope) / (half - 0.46 * slope)
print(f"cone: conicity {conicity[-1]:.5f}, closed form {expected:.5f};", end=" ")
print(f"S1002 at 3 mm: {difference['S1002'][6] / 6:.3f}")
assert np.allclose(conicity, expected, rtol=2e-3)
