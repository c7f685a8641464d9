"""Static press of whole sections with two patches against CalculiX: tread and gauge corner."""

from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.verification.cases.calculix_faces import press_checks
from contactstudy.verification.cases.calculix_whole import whole_press
from contactstudy.verification.cases.flat_press import FacetPress
from contactstudy.verification.check import CaseResult, Check, check_shown

CORNER = """

As drawn the wheel touches at the gauge corner alone. The inclined force pushes rail and rim apart
until the tread carries as well, in both programs; wheel and rail then stand 0.45 mm further apart
sideways. CalculiX pairs the faces once a step. With the pairs of an earlier place its answer
depends on where that was: a first step of 110 µm, then the load, gives a share of the gauge corner
of 0.49, and 0.39 once steps at the same load no longer move it, from whatever first step. So the
load step is repeated here, and the last step is held against the one before it.

On faces of 4 mm the two patches are one or two faces wide. Judged are the approach and how much of
the pressure stands below s = -26 mm, on the gauge corner. Area, single pressures and the lateral
force are reported: the program sums forces along the normals of the places that the undeformed
bodies have, and its lateral force comes out 8 to 12 % low, depending on where the mesh lies.
"""
GAUGE_CORNER = -0.026
"""Arc length on the wheel's profile in m that divides the patches."""
START = 265e-6
"""m that the hub comes down in the first step, nearly the approach: fewer steps settle it."""


def press_on_gauge_corner() -> CaseResult:
    """A shift with two patches; some minutes of CalculiX."""
    found = whole_press("wheelset.lateral_shift=5.5 mm", start=START, repeats=2)
    flat, smooth, theirs, before = found.flat, found.smooth, found.theirs, found.steps[-2]

    def share(how: str, ours: FacetPress, other: FacetPress, band: float | None) -> Check:
        shares = corner_share(found.wheel, ours), corner_share(found.wheel, other)
        return Check(f"share of the gauge corner, {how}", *shares, "", found.source, band, scale=1)

    settled = "CalculiX's last step against the one before"
    forces = theirs.lateral_force, before.lateral_force
    checks = (
        found.vertical(),
        share(settled, theirs, before, 0.002),
        check_shown(f"lateral force, {settled}", *forces, "kN", found.source, 0.005),
        share("flat faces", flat, theirs, 0.02),
        found.lateral("flat faces", flat),
        *press_checks("flat faces", flat, theirs, found.source, (0.02, None, None)),
        share("smooth profiles", smooth, theirs, None),
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
