"""What scatter does to the curvature: stated as large as it is against the drawing."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.named import rail_curve
from contactstudy.profiles.outliers import KNOTS
from contactstudy.profiles.scatter import curvature_error, doubted
from contactstudy.profiles.worn import SPACINGS, fitted_curve, worn_curve

DRAWN = rail_curve("60E1")
AT = np.linspace(-0.02, 0.02, 801)
WAYS = [KNOTS * factor for factor in SPACINGS]


def measured(spacing, noise, seed):
    s = np.arange(-0.0355, 0.0355, spacing)
    off = noise * np.random.default_rng(seed).standard_normal((len(s), 1))
    return DRAWN.point(s) + off * DRAWN.normal(s)


def error_and_stated(points, noise):
    curve = fitted_curve(points, "rail")
    at = curve.arc_of_y(DRAWN.point(AT)[:, 0])
    error = np.sqrt(np.mean((curve.curvature(at) - DRAWN.curvature(AT)) ** 2))
    return error, curvature_error(curve, noise, len(points), WAYS)


@pytest.mark.slow
@pytest.mark.parametrize(("spacing", "noise"), [(0.2e-3, 3e-6), (0.5e-3, 3e-6), (0.5e-3, 10e-6)])
def test_the_stated_error_of_the_curvature_is_the_true_one(spacing, noise):
    """Medians of eight draws. Both hold what is lost at the joints, for the fit has them too."""
    found = [error_and_stated(measured(spacing, noise, seed), noise) for seed in range(8)]
    true, stated = np.median(found, axis=0)
    print(f"{spacing} m, {noise} m: true {true:.3g} 1/m, stated {stated:.3g} 1/m")
    assert stated == pytest.approx(true, rel=0.25)


def test_scatter_is_judged_by_the_curvature_that_it_leaves():
    """One limit for profiles and scans; many points that scatter do as much as few that do not."""
    curve = fitted_curve(measured(0.2e-3, 0.0, 0), "rail")
    assert doubted(curve, 0.1e-6, 355, WAYS) == ""
    assert "scatter by 10 um" in doubted(curve, 10e-6, 355, WAYS)
    assert doubted(curve, 10e-6, 100_000, WAYS) == ""
    coarse = fitted_curve(measured(1e-3, 0.0, 0), "rail")
    with pytest.raises(InputError, match="allowed: up to 10 1/m"):
        doubted(coarse, 300e-6, 72, WAYS)


@pytest.mark.parametrize("form", ["scattered", "single precision at 300 m"])
def test_a_profile_that_scatters_is_warned_of(tmp_path, form):
    points = measured(0.2e-3, 10e-6 if form == "scattered" else 0.0, 1)
    if form != "scattered":
        points[:, 1] = (points[:, 1] + 300.0).astype(np.float32)
    file = tmp_path / "worn.csv"
    rows = [f"{y:.9g},{z:.9g}" for y, z in points]
    file.write_text("\n".join(["y [m],z [m]", *rows]))
    (note,) = worn_curve(file, "rail").notes
    assert "scatter by" in note and "uncertain by" in note
