"""Defects of the wheel, by the names that a study gives them."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.depth_map import DepthMap
from contactstudy.irregularity.flats import Flat, RoundedFlat, WheelDefect
from contactstudy.validation import AtLeast, Key, Naming, Unit, Usual, Variants, complaint


@dataclass(frozen=True)
class OutOfRound(WheelDefect):
    """A wheel that is not round, sum of a cos(n (X - X_0)/R + phi); a polygon is one order."""

    orders: Annotated[
        tuple[int, ...], AtLeast(1), Key("wheel_defect_orders"), "waves round the wheel"
    ] = (1,)  # fmt: skip
    amplitudes: Annotated[
        tuple[float, ...], Unit("m"), AtLeast(0), Usual(1e-8, 5e-3),
        Key("wheel_defect_amplitudes"), "of each order, up",
    ] = (1e-4,)  # fmt: skip
    phases: Annotated[
        tuple[float, ...], Unit("rad"), Key("wheel_defect_phases"), "of each order; 0 if left out"
    ] = ()

    def problems(self, key: Naming) -> list[str]:
        """Lists that are not equally long."""
        n = len(self.orders)
        lists = {"amplitudes": self.amplitudes, "phases": self.phases}
        return [
            complaint(key(name), list(given), f"must be {n} numbers, one an order")
            for name, given in lists.items()
            if len(given) != n and (name == "amplitudes" or given)
        ] + ([] if n else [complaint(key("orders"), [], "must be one order or more")])

    def terms(self, radius: float) -> tuple[Array, Array, Array]:
        """Amplitudes [m], wavenumbers [rad/m] and phases at X = 0 [rad] of a rolling wheel."""
        k = np.array(self.orders, dtype=float) / radius
        phases = np.array(self.phases or np.zeros(len(k)), dtype=float)
        return np.array(self.amplitudes), k, phases - k * self.at


WHEEL_DEFECTS = Variants(
    "wheel_defect",
    {
        "none": None,
        "flat": Flat,
        "rounded_flat": RoundedFlat,
        "depth_map": DepthMap,
        "out_of_round": OutOfRound,
    },
    "defect of the wheel, on top of the spectrum; a polygon is out of round by one order",
)
