"""Contact points at the nodes and at Gauss points come to the same as the mesh gets finer."""

import numpy as np

from contactstudy.compare.refinement import fitted_order
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.verification.cases.pressed_blocks import blocks

RADII, ELEMENTS = (0.43, 0.30), (2, 3, 4, 6)
LARGEST = hertz_contact(80e3, contact_modulus(), *RADII)


def test_they_come_together_with_second_order() -> None:
    # areas of nodes (trapezoidal) and of Gauss points differ from the pressure's integral, and
    # the lower body's spline from the upper one's facets, by h^2
    loads = np.geomspace(20e3, 80e3, 9)
    approach, peak = [], []
    for elements in ELEMENTS:
        axes = (LARGEST.semi_axis_x, LARGEST.semi_axis_y)
        gauss, nodes = (
            [blocks(axes, elements, RADII, quadrature=q).press(load, 1e17) for load in loads]
            for q in ("gauss", "nodes")
        )
        pairs = list(zip(gauss, nodes, strict=True))
        approach.append(np.mean([abs(n.approach / g.approach - 1) for g, n in pairs]))
        peak.append(
            np.mean([abs(n.ellipse.peak_pressure / g.ellipse.peak_pressure - 1) for g, n in pairs])
        )
    sizes = 1 / np.array(ELEMENTS)
    for name, found in (("approach", approach), ("peak pressure by moments", peak)):
        order = fitted_order(sizes, found)
        print(f"{name}: nodes against Gauss points", np.round(found, 4), f"order {order:.2f}")
        assert order > 1.7
        assert np.all(np.diff(found) < 0)
