"""metrics.json of two made-up runs, against norms known in closed form."""

import json

import numpy as np
import pytest
import xarray as xr

from contactstudy.compare.bands import level_differences
from contactstudy.study.kinds.passage.metrics import study_metrics

SPEED = 50.0
STATIC = 60e3


def run(dt: float, gain: float = 1.0, end: float = 30.0) -> xr.Dataset:
    """Force 60 kN + gain 5 kN sin^2-started sine of 1 m wavelength from X = 6 m on."""
    time = np.arange(round((end - 6.0) / SPEED / dt) + 1) * dt
    x = 6.0 + SPEED * time
    wave = np.sin(2 * np.pi * x)
    signals = {
        "contact_force": STATIC + gain * 5e3 * wave,
        "wheel_displacement": -1e-3 + gain * 2e-4 * wave,
        "wheel_acceleration": 0.0 * wave,
    }
    data = {name: ("time", values) for name, values in signals.items()}
    coords = {"time": time, "position": ("time", x)}
    return xr.Dataset(data, coords, {"dofs": 7, "steps": len(time) - 1, "dt": dt})


COST = {"seconds": {"setup": 0.1, "stepping": 0.2}, "peak_memory_mb": 99.0}


def metrics(**runs: xr.Dataset) -> dict:
    return study_metrics(runs, dict.fromkeys(runs, COST), "surface", compare_from=9.0)


def test_penetration_left_by_surface_contact():
    data = run(1e-4).assign(penetration=("time", np.array([0.0, 2e-9, *np.zeros(4799)])))
    data = data.assign(press_penetration=("press", np.array([1e-9, 3e-9])))
    found = metrics(surface=data)["runs"]["surface"]
    assert found["penetration"] == 2e-9 and found["penetration_of_press"] == 3e-9


def test_layout_and_json():
    found = metrics(surface=run(1e-4), point=run(1e-4, 1.05))
    assert found["runs"]["point"] == {"dofs": 7, "steps": 4800, "dt": 1e-4, **COST}
    assert list(found["comparisons"]) == ["point"]
    assert set(found["comparisons"]["point"]["contact_force"]) == {
        "relative_l2", "relative_l2_dynamic", "linf", "rms", "correlation",
        "sprague_geers", "sprague_geers_dynamic", "third_octave",
    }  # fmt: skip
    json.dumps(found, allow_nan=False)


def test_norms_of_a_gain_of_five_percent():
    """From 9 to 30 m are 21 whole waves: the mean of sin^2 is 1/2."""
    force = metrics(surface=run(1e-4), point=run(1e-4, 1.05))["comparisons"]["point"][
        "contact_force"
    ]
    rms = 0.05 * 5e3 / np.sqrt(2)
    assert force["rms"] == pytest.approx(rms, rel=1e-6)
    assert force["relative_l2"] == pytest.approx(rms / np.sqrt(STATIC**2 + 12.5e6), rel=1e-6)
    assert force["relative_l2_dynamic"] == pytest.approx(0.05, rel=1e-6)
    assert force["linf"] == pytest.approx(250.0, rel=1e-6)
    assert force["correlation"] == pytest.approx(1.0)
    assert force["sprague_geers_dynamic"]["M"] == pytest.approx(0.05)
    assert force["sprague_geers_dynamic"]["P"] == pytest.approx(0.0, abs=1e-7)
    level = force["third_octave"]["50"]  # 1 m at 50 m/s
    assert level == pytest.approx(20 * np.log10(1.05), abs=1e-6)


def test_different_time_steps_are_compared_at_equal_positions():
    """4e-5 and 1e-4 s share every fifth of 2 m/s positions only; the signal is the same."""
    found = metrics(surface=run(4e-5), point=run(1e-4))["comparisons"]["point"]
    assert found["contact_force"]["relative_l2_dynamic"] < 1e-8
    assert found["wheel_displacement"]["linf"] < 1e-11


def test_a_shorter_run_is_compared_where_both_are():
    found = metrics(surface=run(1e-4), point=run(1e-4, 1.05, end=20.0))["comparisons"]["point"]
    assert found["contact_force"]["relative_l2_dynamic"] == pytest.approx(0.05, rel=1e-6)


def test_what_does_not_exist_is_null():
    found = metrics(surface=run(1e-4), point=run(1e-4))["comparisons"]["point"]
    assert found["wheel_acceleration"]["relative_l2"] is None
    assert found["wheel_acceleration"]["correlation"] is None
    assert found["wheel_acceleration"]["linf"] == 0.0
    assert found["wheel_acceleration"]["third_octave"] == {}


def test_level_differences_of_two_tones():
    x = np.linspace(0, 20, 20001)
    one, other = np.sin(2 * np.pi * x), 0.1 * np.sin(2 * np.pi * 4 * x)
    levels = level_differences(2 * one + other, one + other, x, SPEED)
    assert levels["50"] == pytest.approx(20 * np.log10(2), abs=0.01)
    assert levels["200"] == pytest.approx(0.0, abs=0.01)


def test_nothing_to_compare():
    found = study_metrics({"point": run(1e-4)}, {"point": COST}, None, 9.0)
    assert found["comparisons"] == {} and found["reference"] is None


def test_a_run_the_other_way_is_not_compared():
    """Its positions count from where it enters: equal ones are not equal places."""
    ahead = run(1e-4)
    turned = ahead.assign_coords(position=36.0 - ahead["position"])
    turned = turned.assign_attrs(start=6.0, travel="backward")
    found = metrics(surface=run(1e-4), point=run(1e-4, 1.05), back=turned)
    assert list(found["comparisons"]) == ["point"] and "back" in found["runs"]
    both = {"surface": turned, "back": turned}
    assert list(metrics(**both)["comparisons"]) == ["back"]


def test_nothing_is_compared_with_a_dynamic_part_that_is_next_to_nothing():
    """4 sin of 67.4 kN: a difference as large would be 100 % of it."""
    force = metrics(surface=run(1e-4, 1e-3), point=run(1e-4, 2e-3))["comparisons"]["point"][
        "contact_force"
    ]
    assert force["relative_l2_dynamic"] is None and force["sprague_geers_dynamic"]["M"] is None
    assert force["relative_l2"] == pytest.approx(5.0 / np.sqrt(2) / STATIC, rel=1e-3)


def test_the_wheel_is_compared_from_rest():
    """A spring without the static approach stands 0.1 mm higher, and moves just the same."""
    reference = run(1e-4)
    same, worse = reference.copy(deep=True), run(1e-4, 1.2)
    same["wheel_displacement"] = same["wheel_displacement"] + 1e-4
    found = metrics(surface=reference, linear=same, other=worse)["comparisons"]
    linear, other = (found[name]["wheel_displacement"] for name in ("linear", "other"))
    assert linear["linf"] < 1e-15 and linear["relative_l2"] < 1e-12
    assert other["linf"] == pytest.approx(4e-5, rel=1e-6)
    for norm in ("linf", "rms", "relative_l2", "relative_l2_dynamic"):
        assert linear[norm] < other[norm], norm
    # of the force a static difference counts
    same["contact_force"] = same["contact_force"] + 100.0
    assert metrics(surface=reference, linear=same)["comparisons"]["linear"]["contact_force"][
        "linf"
    ] == pytest.approx(100.0)


def test_bands_without_content_are_left_out():
    """41 dB below the highest band there is nothing to compare, 39 dB below there is."""
    x = np.linspace(0, 20, 20001)
    for level, kept in ((-39.0, True), (-41.0, False)):
        quiet = 10 ** (level / 20) * np.sin(2 * np.pi * 4 * x)
        reference = np.sin(2 * np.pi * x) + quiet
        levels = level_differences(reference + quiet, reference, x, SPEED)
        assert ("200" in levels) == kept
        if kept:
            assert levels["200"] == pytest.approx(20 * np.log10(2), abs=0.05)


def small(gain: float) -> xr.Dataset:
    """A run whose force swings by so much of 5 kN; its value at rest is that of all."""
    return run(1e-4, gain)


def test_next_to_no_dynamic_part_is_not_compared():
    """5 kN make a root mean square of 5.9 % of 60 kN: a tenth of it may be compared."""
    large = metrics(surface=small(0.1), point=small(0.05))
    assert large["dynamic_part"]["compared"]
    assert large["dynamic_part"]["rms"] == pytest.approx(500 / np.sqrt(2), rel=1e-3)
    found = metrics(surface=small(0.05), point=small(0.1))
    assert not found["dynamic_part"]["compared"]
    assert found["dynamic_part"]["of_static"] == pytest.approx(250 / np.sqrt(2) / STATIC, rel=1e-3)
    for signal, entry in found["comparisons"]["point"].items():
        assert entry["relative_l2_dynamic"] is None, signal
        assert entry["sprague_geers_dynamic"] == {"M": None, "P": None, "C": None}
        assert entry["third_octave"] == {}
    assert found["comparisons"]["point"]["contact_force"]["relative_l2"] is not None
