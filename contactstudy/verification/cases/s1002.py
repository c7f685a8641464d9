"""S1002 on inclined 60E1: the meshed wheel and rail against half-spaces of the same shape."""

from __future__ import annotations

import numpy as np

from contactstudy.contact.groups import contact_area
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.geometry.placement import Geometry
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.halfspace.patches import WheelPress, press_wheel
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.loading import load_study
from contactstudy.verification.cases.contact_ellipse import contact_ellipse
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

LOADS = np.array([0.25, 0.5, 0.75, 1.0]) * 67.4e3
_METHOD = """
The study s1002_inclined: wheel S1002 centred on standard gauge, 60E1 inclined 1:40, default mesh
of whole sections (2 mm), pressed from a quarter of the static wheel load to all of it. The
reference is the half-space with the same gap (Love's influence, cells of a sixty-fourth of the
patch), which the Manchester benchmark and Tamaas check. Semi-axes are those of the ellipse of
Hertz with the second moments of the pressure, on both sides. The patch is long across the rail and
short along it, a semi-axis there being two elements and a half. The area is the one that a run
reports, from the gap around the patch, against the half-space's cells under pressure. The solid's
approach holds the compliance of wheel and rail at large too: one constant in m/N, fixed at the full
load, is taken off, and the smaller loads are compared.

The peak pressure is reported, not judged: it lies on a ridge about one element wide, where the
rail's radius goes from 300 to 80 mm, which 2 mm elements flatten. A study of positions resolves it.
"""


_SOURCE = "half-space, Love (1929)"


def solid_press() -> CaseResult:
    """Static press at four loads, solid bodies beside the half-space."""
    study = load_study("s1002_inclined")
    placed = geometry(study)
    exact = [_half_space(study, placed, float(load)) for load in LOADS]
    wheel = build.wheel(study)
    track = build.solid_track(study, build.track(study))
    contact = SurfaceContact(wheel, placed, penalty=study.solid.penalty)
    curve, points = geometry_press(track, contact, LOADS), contact.points
    # delta_solid = delta_half-space + c F
    far = (curve.approach[-1] - exact[-1].travel) / LOADS[-1]
    checks: list[Check] = []
    rows: list[tuple[float, ...]] = []
    for load, approach, solution, gap, reference in zip(
        LOADS, curve.approach, curve.solutions, curve.gaps, exact, strict=True
    ):
        (patch,) = reference.patches
        ellipse = contact_ellipse(points, solution.forces)
        peak = float(points.nodal_pressure(solution.forces).max())
        area = contact_area(points, gap, solution.forces)
        own, theirs = approach - far * load, reference.travel
        at = f"at {load / 1e3:.1f} kN"
        checks += [
            check_shown(f"{quantity} {at}", computed, wanted, unit, _SOURCE, band, scale)
            for quantity, computed, wanted, unit, band, scale in (
                ("semi-axis along", ellipse.along, patch.along, "mm", 0.03, None),
                ("semi-axis across", ellipse.across, patch.across, "mm", 0.03, None),
                ("centre of pressure", ellipse.centre[1], patch.centre.y, "mm", 0.06, patch.across),
                ("area", area, patch.area, "mm²", 0.05, None),
                ("peak pressure", peak, patch.peak_pressure, "MPa", None, None),
            )
        ]
        if load < LOADS[-1]:
            checks.append(check_shown(f"approach {at}", own, theirs, "µm", _SOURCE, 0.02))
        secant = load / own * 1e-9
        rows.append((load / 1e3, approach * 1e6, own * 1e6, theirs * 1e6, secant))
    table = ResultTable(
        f"Approach of hub and rail's centre line; far field {far * 1e9:.4f} µm/kN taken off",
        ("load (kN)", "solid (µm)", "less far field (µm)", "half-space (µm)", "secant (GN/m)"),
        tuple(rows),
    )
    return CaseResult(
        "s1002_solid",
        "S1002 on inclined 60E1: solid bodies against the half-space",
        _METHOD.strip(),
        tuple(checks),
        tables=(table,),
    )


def _half_space(study: Study, placed: Geometry, load: float) -> WheelPress:
    modulus = contact_modulus(study.track.rail.youngs_modulus, study.track.rail.poisson_ratio)
    return press_wheel(placed, load, modulus)
