"""What is measured of impacts, of studies that have a defect at one place.

::

    lost_time, lost_length, impulse (run)     see `contactstudy.compare.impact`

and the closed forms P1 and P2 of a dipped joint, which stand beside the runs' largest forces.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from contactstudy.compare.impact import Impact, impact
from contactstudy.compare.lumped_track import for_p1, for_p2
from contactstudy.compare.signals import position, values
from contactstudy.irregularity import DippedJoint
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.study.axes.measured import Measured, measured
from contactstudy.study.kinds.passage.contact import hertz
from contactstudy.study.kinds.passage.schema import Study

if TYPE_CHECKING:
    import xarray as xr

VARIABLES = {
    "lost_time": ("s", "time without contact"),
    "lost_length": ("m", "way without contact"),
    "impulse": ("N*s", "impulse of the contact force beyond the static one"),
}


def impact_of(run: xr.Dataset) -> Impact:
    """The impact in the contact force of a run, from its start on."""
    force = values(run, "contact_force")
    return impact(run["time"].values, position(run), force, float(force[0]))


def closed_forms(study: Study) -> dict[str, float]:
    """P1 and P2 of a dipped joint in N, the static load included; nothing for another defect."""
    joint, load = study.irregularity.rail_defect, study.vehicle.static_load
    if not isinstance(joint, DippedJoint) or study.track.support is None:
        return {}
    kink, wheel = joint.angle * study.journey.speed, study.vehicle.wheel_mass
    stiffness = hertz(study).tangent_stiffness
    return {
        "P1": load + for_p1(study.track, wheel, stiffness).p1(kink),
        "P2": load + for_p2(study.track, wheel, stiffness).p2(kink),
    }


def impacts(study: Study, runs: Mapping[str, xr.Dataset]) -> Measured:
    """Measure the impacts of a variant's runs; nothing without a defect at one place."""
    irregularity = study.irregularity
    if not (irregularity.rail_defect or isinstance(irregularity.wheel_defect, LocalDefect)):
        return {}
    found = {name: impact_of(run) for name, run in runs.items()}
    return {
        name: measured(unit, text, ["run"], {run: getattr(i, name) for run, i in found.items()})
        for name, (unit, text) in VARIABLES.items()
    }
