"""Refinement of refinements: known orders from made-up runs, and a small real one."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.verification.cases.refined_runs import refined
from contactstudy.verification.cases.refinement import Refinement, common, differences
from contactstudy.verification.cases.refinement_report import (
    difference_plot,
    left_checks,
    peak_over_hertz,
    tables,
)

STATIC, SPEED = 7e4, 80.0


def fake(step: float, error: float) -> xr.Dataset:
    """A run whose force is off by `error` times a wave of 100 Hz."""
    t = step * np.arange(round(0.05 / step) + 1)
    wave = np.sin(2 * np.pi * 100 * t)
    force = STATIC * (1 + 0.1 * np.sin(2 * np.pi * 60 * t) + error * wave)
    return xr.Dataset(
        {
            "contact_force": ("time", force),
            "peak_pressure": ("time", 1e9 * np.cbrt(force / STATIC) * (1 + error)),
            "contact_area": ("time", np.full(len(t), 1e-4)),
            "penetration": ("time", np.full(len(t), 1e-7)),
        },
        {"time": t, "position": ("time", 10.0 + SPEED * t)},
        {"static_load": [STATIC], "fade_in": 1.0},
    )


def made_up(order: float, constant: float = 1e-4) -> Refinement:
    sizes = (4.0, 2.0, 1.0, 0.5)
    runs = tuple(fake(2e-4 / 2**k, constant * h**order) for k, h in enumerate(sizes))
    return Refinement(sizes, sizes, 1, runs)


@pytest.mark.parametrize("order", [1.0, 2.0, 3.0])
def test_known_order_and_error(order: float) -> None:
    found = made_up(order)
    np.testing.assert_allclose(found.orders, order, rtol=0.02)
    # what is left is the error itself, against a run without any
    exact = differences(found.runs[1], fake(1e-4, 0.0))
    np.testing.assert_allclose(found.left_at_default, exact, rtol=0.02)


def test_without_an_order_the_last_step_is_added() -> None:
    runs = tuple(fake(1e-4, e) for e in (2e-3, 1e-3, 3e-3))
    found = Refinement((3.0, 2.0, 1.0), (3.0, 2.0, 1.0), 1, runs)
    assert np.isnan(found.orders[0, 0])
    np.testing.assert_allclose(found.left_at_default, 2 * found.against_finest[1], rtol=1e-6)


def test_common_positions() -> None:
    a, b = common(fake(2e-4, 0.0), fake(5e-5, 0.0))
    np.testing.assert_allclose(a.position, b.position)
    assert float(a.position[0]) == pytest.approx(11.008) and len(a.time) == len(b.time)


def test_report_of_a_series() -> None:
    found = made_up(2.0)
    first, orders = tables("size (m)", 1.0, found)
    assert len(first.rows) == 4 and len(orders.rows) == 2
    assert first.rows[-1][1:6] == (0.0,) * 5
    assert "2" in difference_plot("size (m)", 1.0, found).caption
    checks = left_checks(found, "size", (1.0, 50.0, 100.0))
    assert [c.reference for c in checks] == [1.0, 50.0, 100.0]
    assert all(c.passed for c in checks)
    assert np.all(np.diff(peak_over_hertz(found)) < 0)


def test_time_step_of_a_short_real_run() -> None:
    shorter = ("journey.to=13.6 m", "journey.fade_in=0.4 m", "solid.mesh_size=5 mm")
    found = refined("journey.time_step", (2e-4, 1e-4, 5e-5), 5e-5, shorter)
    print("against finest", found.against_finest, "orders", found.orders)
    assert np.all(found.against_finest[0, :3] > found.against_finest[1, :3])
    assert found.against_finest[1, 0] < 5e-3


@pytest.mark.parametrize(
    ("name", "scale", "default", "finest"),
    [
        ("mesh size (mm)", 1.0, "mesh size 2 mm", "mesh size 0.5 mm"),
        ("penalty (Pa/m), nodes", 1e16, "penalty 2·10¹⁶ Pa/m, nodes", "penalty 5·10¹⁵ Pa/m, nodes"),
        ("interface modes", 4.0, "interface modes 8", "interface modes 2"),
    ],
)
def test_captions_name_levels_with_their_units(name, scale, default, finest):
    series = made_up(1.0)
    assert f"At the default ({default})" in difference_plot(name, scale, series).caption
    assert tables(name, scale, series)[0].caption == f"Differences from the finest level, {finest}"
