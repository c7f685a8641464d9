"""Synthetic scans of S1002 and 60E1: the fitted shapes and their contact against the exact ones."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.halfspace.patches import press_wheel
from contactstudy.plot.curves import Plot, curve
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.worn import Body
from contactstudy.scans import Scan, meeting, read_scan
from contactstudy.verification.cases.synthetic_scan import (
    NOISE,
    RADIUS,
    STEP,
    Standing,
    synthetic_scan,
)
from contactstudy.verification.check import (
    CaseResult,
    Check,
    ResultTable,
    check_at_most,
    check_shown,
)

LOAD = 67.4e3
POSES = {
    "centred": Pose(math.atan(1 / 40)),
    "3 mm inwards, yaw 6 mrad": Pose(math.atan(1 / 40), -3e-3, 0.0, 6e-3),
}
_HALF_LENGTHS = {"rail": 0.05, "wheel": 0.06}
_EDGE = 2e-3  # from the ends of a fitted curve, left out of the comparison of shapes [m]
_CURVATURE_OVER = 3e-3  # length over which curvatures are averaged [m]


def scanned_profiles() -> CaseResult:
    """Scans of 60E1 and S1002, in STL and so in single precision, against the exact profiles."""
    exact = {"rail": rail_curve("60E1"), "wheel": wheel_curve("S1002")}
    scans = _scans(exact)
    checks, figures = [], []
    for body, scan in scans.items():
        shape, figure = _shape(scan, exact[body])
        checks += shape
        figures.append(figure)
    fit = scans["wheel"].fit
    checks.append(Check("radius of the wheel", fit.radius, RADIUS, "m", "the scan's making", 2e-4))
    modulus = contact_modulus(210e9, 0.3)
    for name, pose in POSES.items():
        found = meeting(scans["rail"], scans["wheel"], RADIUS, pose, 0.01, 0.008)
        drawn = Geometry(exact["rail"], exact["wheel"], RADIUS, pose)
        fitted = Geometry(scans["rail"].curve, scans["wheel"].curve, RADIUS, pose)
        touch = drawn.touch
        ours, theirs = (press_wheel(bodies, LOAD, modulus) for bodies in (fitted, drawn))
        a, b, halves = ours.patches[0], theirs.patches[0], "exact profiles, half-spaces"
        checks += [
            check_shown(f"{quantity}, {name}", computed, reference, unit, source, band, scale)
            for quantity, computed, reference, unit, source, band, scale in (
                ("first touch on the rail", found.smooth.arc, touch.arc, "mm",
                 "exact profiles; over the patch's semi-axis", 0.1, b.across),
                ("height of the facets' first touch", found.facets.travel, touch.travel, "µm",
                 "exact profiles; over the approach", 0.1, theirs.travel),
                ("approach", ours.travel, theirs.travel, "µm", halves, 0.01, None),
                ("peak pressure", a.peak_pressure, b.peak_pressure, "MPa", halves, 0.03, None),
                ("area", a.area, b.area, "mm²", halves, 0.03, None),
            )
        ]  # fmt: skip
    rows = [
        (name, fit.points, 1e6 * fit.rms, 1e6 * fit.largest, 1e6 * fit.scatter, fit.knots)
        for name, fit in ((scan.name, scan.fit) for scan in scans.values())
    ]
    table = ResultTable(
        "Fits of the smooth surfaces to the scans.",
        ("scan", "points", "residual rms (µm)", "largest (µm)", "scatter (µm)", "knots"),
        tuple(rows),
    )
    return CaseResult(
        "scanned_profiles",
        "Scanned rail head and wheel tread",
        f"60E1 and S1002 are triangulated irregularly at {1e3 * STEP:g} mm, every coordinate gets "
        f"{1e6 * NOISE:g} µm of noise, and the surfaces, turned by a few mrad and with their "
        "triangles in any order, are written as STL in mm. They are read again as a user's "
        "scans would be; direction, axle and generating curves are fitted.\n\n"
        "Fitted and exact profiles are then touched and pressed as half-spaces with "
        f"{1e-3 * LOAD:g} kN in the same positions.",
        tuple(checks),
        (table,),
        tuple(figures),
    )


def _scans(exact: dict[str, ProfileCurve]) -> dict[str, Scan]:
    """Write the scans and read them again."""
    scans = {}
    with tempfile.TemporaryDirectory() as folder:
        for seed, (body, profile) in enumerate(exact.items()):
            at = (0.02, 4e-3, 0.03)
            pitch = 1.5e-3 if body == "rail" else 0.0
            standing = Standing(3e-3, pitch, at)
            mesh = synthetic_scan(profile, _HALF_LENGTHS[body], seed, standing=standing)
            mesh.apply_scale(1e3)
            path = Path(folder) / f"{profile.name}.stl"
            mesh.export(path)
            kind: Body = "rail" if profile.upper else "wheel"
            scans[body] = read_scan(path, "mm", kind, origin=at[1])
    return scans


def _shape(scan: Scan, exact: ProfileCurve) -> tuple[list[Check], Plot]:
    """Residual, error of the curve and of its curvature."""
    low, high = scan.curve.s_range
    s = np.arange(low + _EDGE, high - _EDGE, 0.1e-3)
    _, error = exact.project(scan.curve.point(s))
    kind = exact.name
    # where a wheel runs: crown to gauge corner, tread to flange root
    inner = np.abs(s) < 0.03
    noise, largest = 1e6 * NOISE, float(np.abs(error[inner]).max())
    fitted = f"error of the fitted {kind}"
    checks = [
        Check(f"residual of {kind}, rms", 1e6 * scan.fit.rms, noise, "µm", "the noise", 0.1),
        check_at_most(f"{fitted}, rms", 1e6 * _rms(error[inner]), noise, "µm", "below the noise"),
        check_at_most(f"{fitted}, largest", 1e6 * largest, noise, "µm", "within the noise"),
    ]
    ours, theirs = (_mean_curvature(c, s) for c in (scan.curve, exact))
    scale, turned = float(np.abs(theirs[inner]).max()), _rms((ours - theirs)[inner])
    name = f"error of the curvature of {kind} over {1e3 * _CURVATURE_OVER:g} mm, rms"
    source = f"over the largest curvature, {scale:.3g} 1/m"
    checks.append(Check(name, turned, 0.0, "1/m", source, None, scale=scale))
    figure = Plot(
        f"Distance of the curve fitted to the scan of {kind} from the exact profile: "
        f"{1e6 * largest:.2g} µm at most within 30 mm of its origin, "
        f"from points with {1e6 * NOISE:g} µm of noise each.",
        "arc length (mm)",
        "error (µm)",
        (curve(kind, 1e3 * s, 1e6 * error),),
    )
    return checks, figure


def _mean_curvature(profile: ProfileCurve, s: Array) -> Array:
    """Mean curvature over a length of the curve: what its normal turns by."""
    half = 0.5 * _CURVATURE_OVER
    before, after = profile.normal(s - half), profile.normal(s + half)
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    side = -1.0 if profile.upper else 1.0
    return np.asarray(side * np.arcsin(turn) / (2.0 * half))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
