"""Static press of whole sections with two patches against CalculiX: tread and gauge corner."""

from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.verification.cases.calculix_faces import press_checks
from contactstudy.verification.cases.calculix_whole import whole_press
from contactstudy.verification.cases.flat_press import FacetPress
from contactstudy.verification.check import CaseResult, Check

CORNER = """

As drawn the wheel touches at the gauge corner alone. The inclined force pushes rail and rim apart
until the tread carries as well, in both programs. On faces of 4 mm the two patches are one or two
faces wide; approach, area and single pressures are reported, and how much of the pressure stands
below s = -26 mm, on the gauge corner. Judged is the lateral force. CalculiX follows the faces as
they move sideways, which the linear program does not.
"""
GAUGE_CORNER = -0.026
"""Arc length on the wheel's profile in m that divides the patches."""


def press_on_gauge_corner() -> CaseResult:
    """A shift with two patches."""
    found = whole_press("wheelset.lateral_shift=5.5 mm")
    flat, smooth, theirs = found.flat, found.smooth, found.theirs
    ours, reference = (corner_share(found.wheel, press) for press in (flat, theirs))
    checks = (
        found.vertical(),
        found.lateral("flat faces", flat, 0.03),
        *press_checks("flat faces", flat, theirs, found.source, (None, None, None)),
        Check("share of the gauge corner, flat faces", ours, reference, "", found.source, None),
        found.lateral("smooth profiles", smooth),
        *press_checks("smooth profiles", smooth, theirs, found.source, (None, None, None)),
    )
    return CaseResult(
        name="calculix_corner",
        title="S1002 on inclined 60E1 in CalculiX: tread and gauge corner",
        method=found.method("5.5 mm to the side") + CORNER,
        checks=checks,
        tables=(found.table(),),
    )


def corner_share(wheel: WheelFlexibility, press: FacetPress) -> float:
    """Part of the faces' pressures that stands on the gauge corner."""
    below = 0.5 * (wheel.y[1:] + wheel.y[:-1]) < GAUGE_CORNER
    return float(press.face_pressure[:, below].sum() / press.face_pressure.sum())
