"""The contact-patch filter: how much of a short wave the wheel follows, statically."""

from __future__ import annotations

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.complementarity import press
from contactstudy.contact.press_table import load_weights
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.halfspace.love import love_influence
from contactstudy.plot.curves import Plot, curve
from contactstudy.solvers.at_rest import bodies_at_rest
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.runs import SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.verification.cases.wave_filter import (
    PatchPoints,
    ellipse_filter,
    pressed_filter,
    small_amplitude_filter,
)
from contactstudy.verification.check import CaseResult, Check, ResultTable

LOAD = 80e3
"""N"""
RADII = (0.43, 0.30)
"""Wheel and crown, m."""
WAVELENGTHS = np.geomspace(0.010, 0.314, 41)
SHOWN = np.array([0.010, 0.0125, 0.016, 0.020, 0.025, 0.0315, 0.05, 0.1, 0.2, 0.314])
PUBLISHED = ((0.100, 0.973), (0.020, 0.449))
"""Wavelength in m and amplitude ratio of an independent half-space computation."""
CELL = 0.5e-3
"""Rectangles of the half-space, m."""
AMPLITUDE = 10e-6
"""m, of the finite irregularity."""
POSITIONS = 8
"""Places along a wave at which the wheel is pressed."""
RESOLVED = 0.02
"""m, a wave of ten elements of 2 mm."""
METHOD = (
    "A wheel under a constant load of 80 kN stands on a rail with a sinusoidal irregularity, "
    "uniform across it; R 0.43 m on R 0.30 m, E = 210 GPa, ν = 0.3. The amplitude of the wheel's "
    "height, as it stands at one place after the other, is divided by that of the irregularity.\n\n"
    "For a small amplitude the wheel rises by the mean of the irregularity under the patch, "
    "weighted with the forces that come with more load. On half-spaces that is the pressure under "
    "a flat elliptical punch; its integral across the rail is the same at every place along the "
    "patch, so the filter is exactly |sin(ka)/(ka)|, k = 2π/λ, a = half the length of the patch. "
    "Beside it stand half-spaces with Love's influence of rectangles of 0.5 mm, static presses "
    "with an amplitude of 10 µm, and the default study's own rail and wheel at 2 mm. On these the "
    "length of the patch comes in steps of the Gauss points."
)


def influence_matrix(x: Array, y: Array, width: float, breadth: float, modulus: float) -> Array:
    """Approach at the centres (n,) [m] of equal rectangles for unit pressure on each, [m/Pa]."""
    return love_influence(x[:, None] - x[None, :], y[:, None] - y[None, :], width, breadth, modulus)


def half_spaces() -> tuple[Array, Array, Array]:
    """Influence M (n, n) in m/N, gaps and positions along the rail (n,) in m."""
    h = hertz_contact(LOAD, contact_modulus(), *RADII)
    x, y = (
        CELL * np.arange(-n, n + 1)
        for n in (round(1.2 * axis / CELL) for axis in (h.semi_axis_x, h.semi_axis_y))
    )
    X, Y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    M = influence_matrix(X, Y, CELL, CELL, contact_modulus()) / CELL**2
    return M, X**2 / (2 * RADII[0]) + Y**2 / (2 * RADII[1]), X


def real_bodies(mesh_size: float = 0.002) -> tuple[Array, Array]:
    """Weights (n,) and positions (n,) in m of the contact points of the default rail and wheel."""
    solid = Solid(mesh_size=mesh_size)
    study = Study(name="filter", title="Filter", solid=solid, runs={"surface": SurfaceRun()})
    contact = build.surface_contact(study)
    at = bodies_at_rest(build.solid_track(study, build.track(study)), contact)
    M = at.flexibility + np.diag(contact.enforcement.compliance(at.points.area))
    normal = at.points.normal_z
    pressed = press(M, at.points.gap, normal, LOAD)
    return load_weights(M, normal, pressed), at.points.x_of_points


def patch_filter() -> CaseResult:
    """Filter of the contact patch from 10 to 314 mm."""
    a = hertz_contact(LOAD, contact_modulus(), *RADII).semi_axis_x
    M, gap, x = half_spaces()
    normal = np.ones(len(gap))
    points = PatchPoints(M, gap, normal, x)
    weights = load_weights(M, normal, press(M, gap, normal, LOAD))
    bodies = real_bodies()

    def pressed(wavelength: float) -> float:
        return pressed_filter(points, LOAD, wavelength, AMPLITUDE, POSITIONS)

    exact, love = ellipse_filter(a, WAVELENGTHS), small_amplitude_filter(weights, x, WAVELENGTHS)
    ours = small_amplitude_filter(*bodies, WAVELENGTHS)
    finite = np.array([pressed(w) for w in SHOWN])
    closed = "|sin(ka)/(ka)|"
    checks = []
    for wavelength, ratio in PUBLISHED:
        at = np.array([wavelength])
        where = f"amplitude ratio at {1e3 * wavelength:g} mm"
        checks += [
            Check(f"{where}, {how}", value, ratio, "", "independent half-space computation", 0.01)
            for how, value in (
                ("half-spaces", float(small_amplitude_filter(weights, x, at)[0])),
                ("closed form", float(ellipse_filter(a, at)[0])),
                ("amplitude 10 µm", pressed(wavelength)),
            )
        ]
    resolved = WAVELENGTHS >= RESOLVED
    for name, found, of, band in (
        ("half-spaces", love, ~np.isnan(exact), 0.01),
        ("rail and wheel, 2 mm, ten elements a wave or more", ours, resolved, 0.03),
        ("rail and wheel, 2 mm, shorter waves", ours, ~resolved, None),
    ):
        worst = int(np.argmax(np.where(of, np.abs(found - exact), -1.0)))
        pair = float(found[worst]), float(exact[worst])
        where = f"amplitude ratio where it is furthest off, {1e3 * WAVELENGTHS[worst]:.1f} mm"
        checks.append(Check(f"{where}, {name}", *pair, "", closed, band, scale=1.0))
    columns = (
        ellipse_filter(a, SHOWN),
        small_amplitude_filter(weights, x, SHOWN),
        finite,
        small_amplitude_filter(*bodies, SHOWN),
    )
    rows = tuple((1e3 * float(w), *(float(c[i]) for c in columns)) for i, w in enumerate(SHOWN))
    header = ("wavelength (mm)", closed, "half-spaces", "half-spaces, 10 µm", "rail and wheel")
    plot = Plot(
        "Amplitude of the wheel's height over that of the irregularity, static, 80 kN. At 314 mm, "
        f"the shortest wave of the paper's roughness, {100 * (1 - float(columns[0][-1])):.2f} % "
        f"are lost; at {1e3 * 2 * a:.1f} mm, the length of the patch, the wheel does not move.",
        "wavelength (mm)",
        "amplitude ratio",
        (
            curve(closed, 1e3 * WAVELENGTHS, exact, "reference"),
            curve("half-spaces, Love, 0.5 mm", 1e3 * WAVELENGTHS, love, "points"),
            curve("half-spaces, 10 µm", 1e3 * SHOWN, finite, "points"),
            curve("rail and wheel, 2 mm", 1e3 * WAVELENGTHS, ours, "line"),
        ),
        x_scale="log",
    )
    return CaseResult(
        "patch_filter",
        "Contact-patch filter, 10 to 314 mm",
        METHOD,
        tuple(checks),
        (ResultTable("Amplitude ratio", header, rows),),
        (plot,),
    )
