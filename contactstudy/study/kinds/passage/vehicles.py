"""The vehicle of a study."""

from __future__ import annotations

from contactstudy.study.kinds.passage.schema import Study
from contactstudy.vehicle import Vehicle, bare_wheel, wheel_column


def vehicle(study: Study) -> Vehicle:
    """The vehicle of all runs of a study."""
    table = study.vehicle
    if table.type == "bare_wheel":
        return bare_wheel(table.wheel_mass, table.static_load)
    return wheel_column(**table.model_dump(exclude={"type", "static_load"}))
