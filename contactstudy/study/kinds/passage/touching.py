"""Where defects make wheel and rail touch, against the zone that is meshed finely for it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.filters import Trajectory
from contactstudy.exceptions import InputError
from contactstudy.irregularity import with_defects
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.irregularity.profile import SmoothRail
from contactstudy.study.kinds.passage.contact import hertz
from contactstudy.study.kinds.passage.runs import SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.validation import complaint

_STEPS = 1e-4, 1e-3  # m, along the way near a defect, and round a wheel that is not round


def touched_beyond(study: Study) -> tuple[str, ...]:
    """A note where the patch of a surface contact comes near the end of its finely meshed zone.

    A rigid round wheel rests on the edges of a flat or a step, ahead of or behind its centre
    (`contact.filters.Trajectory`), and the patch reaches further by its semi-axis at the static
    load.

    Raises
    ------
    InputError
        If the wheel touches outside of the zone, where nothing is found.
    """
    rough = study.irregularity
    surface = any(
        isinstance(r, SurfaceRun) and r.irregularity == "study" for r in study.runs.values()
    )
    if not surface or not (rough.rail_defect or rough.wheel_defect):
        return ()
    radius, zone = study.vehicle.wheel_radius, study.solid.contact_half_length
    profile = with_defects(SmoothRail(), rough.rail_defect, rough.wheel_defect, radius)
    ahead = 0.0
    for x in _ways(study):
        ahead = max(ahead, float(np.abs(Trajectory(radius).rest(profile, x)[0]).max()))
    key = "solid.contact_half_length"
    where = f"the defect makes wheel and rail touch {1e3 * ahead:.3g} mm from the wheel's centre"
    if ahead >= zone:
        allowed = f"must be above {ahead:.3g} m and half a patch more, for {where}"
        raise InputError(complaint(key, zone, allowed))
    half = _semi_axis(study)
    if ahead + half <= zone:
        return ()
    return (
        f"{complaint(key, zone, f'may be too small: {where}')}, and the patch reaches "
        f"{1e3 * half:.2g} mm further at the static load; a run whose patch leaves the zone stops",
    )


def _ways(study: Study) -> Iterator[Array]:
    """Positions of the wheel (n,) [m] near each defect."""
    rough, journey = study.irregularity, study.journey
    radius = study.vehicle.wheel_radius
    places = list[tuple[float, float, float]]()
    if rough.rail_defect is not None:
        places.append((rough.rail_defect.at, rough.rail_defect.half_length, _STEPS[0]))
    if isinstance(rough.wheel_defect, LocalDefect):  # every revolution shows the same
        half = rough.wheel_defect.half_length(radius)
        places.append((rough.wheel_defect.at, half, _STEPS[0]))
    elif rough.wheel_defect is not None:
        places.append((journey.start, 2.0 * math.pi * radius, _STEPS[1]))
    for at, half, step in places:
        n = int((half + 0.25 * radius) / step)
        x = at + step * np.arange(-n, n + 1)
        met = (x >= journey.start) & (x <= journey.end)
        if met.any():
            yield np.asarray(x[met], dtype=np.float64)


def _semi_axis(study: Study) -> float:
    """That of the patch along the rail at the static load, as Hertz has it [m]."""
    try:
        return hertz(study).semi_axis_x
    except InputError:
        return 0.0  # conformal profiles have no ellipse
