"""What is measured of one variant, as plain data that JSON can hold.

::

    {variable: {"units": "N", "long_name": "...", "dims": ["run", "signal"],
                "values": {"point": {"contact_force": 0.05}}}}

``values`` is nested as deep as there are dims, a plain number without any; labels that a variant
does not have are left out. `contactstudy.study.axes.dataset` puts those of all variants together.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

Measured = dict[str, dict[str, Any]]


def measured(units: str, long_name: str, dims: list[str], values: Any) -> dict[str, Any]:
    """One variable."""
    return {"units": units, "long_name": long_name, "dims": dims, "values": values}


def extremes(study: Any, found: Mapping[str, Any]) -> Measured:
    """Smallest and largest value of every history of every run; of kinds that measure no others."""
    made: Measured = {}
    for run, data in found.items():
        for name, variable in getattr(data, "data_vars", {}).items():
            if variable.dtype.kind not in "fiu" or not variable.size:
                continue
            units = variable.attrs.get("units", "")
            for word, function in (("smallest", np.nanmin), ("largest", np.nanmax)):
                entry = made.setdefault(
                    f"{name}_{word}", measured(units, f"{word} {name}", ["run"], {})
                )
                entry["values"][run] = float(function(variable.values))
    return made
