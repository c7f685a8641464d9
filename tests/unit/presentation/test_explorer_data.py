"""What the explorer's data say, from results whose signals and errors are known."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from built_site import docs_module

from contactstudy.figures.trust import AMPLITUDE, SPEED, WAVELENGTH
from contactstudy.study.results import StudyResults

WAVES, HEIGHTS, SPEEDS = np.geomspace(0.05, 2.0, 5), np.array([2e-6, 2e-5, 2e-4]), [20.0, 80.0]
STATIC, SAMPLES = 67e3, 900


@pytest.fixture(scope="module")
def explorer():
    return docs_module("explorer")


def error(wave, height):
    return 0.3 * (0.05 / wave) * (height / 2e-6) ** 0.2


def force(x, wave, run):
    return (500.0 + 100.0 * run) * np.sin(2 * np.pi * x / wave)


def results():
    dims = [WAVELENGTH, AMPLITUDE, SPEED]
    axes = ((WAVELENGTH, WAVES, "m"), (AMPLITUDE, HEIGHTS, "m"), (SPEED, SPEEDS, "m/s"))
    made = {k: ((k,), np.array(v), {"units": u, "long_name": k}) for k, v, u in axes}
    labels = {"run": ["surface", "point"], "signal": ["contact_force"], "part": ["irregularity"]}
    data = xr.Dataset(coords=made | labels)
    data.attrs = {"design": "sweep", "combine": "grid", "refined": ""}
    shape = tuple(data.sizes[d] for d in dims)
    found = np.broadcast_to(error(WAVES[:, None, None], HEIGHTS[:, None]), shape).copy()
    found[0, -1] = np.nan
    both = np.stack([np.full(shape, np.nan), found], axis=-1)[..., None, None]
    data["relative_l2"] = ([*dims, "run", "signal", "part"], both)
    data["variant"] = (dims, np.full(shape, "x"))
    data["failure"] = (dims, np.where(np.isnan(found), "too sharp", ""))
    data["contact_lost"] = ([*dims, "run"], np.zeros((*shape, 2)))
    data["static"] = ([*dims, "run", "signal"], np.full((*shape, 2, 1), STATIC))
    smooth = STATIC + 30.0 * np.arange(SAMPLES) / SAMPLES  # what sleepers do
    x = 3.0 + np.linspace(0.0, 8.0 * WAVES[:, None], SAMPLES, axis=-1)[:, 0]
    x = np.broadcast_to(x[:, None, None, None, :], (*shape, 2, SAMPLES)).copy()
    y = smooth + force(x, WAVES[:, None, None, None, None], np.arange(2)[:, None])
    x[0, -1] = y[0, -1] = np.nan
    data["position"] = ([*dims, "run", "sample"], x)
    data["contact_force"] = ([*dims, "run", "sample"], y)
    data["contact_force_smooth"] = ([*dims, "run", "sample"], np.broadcast_to(smooth, y.shape))
    return StudyResults(
        "trust_map", "map", "", {"vehicle": {"wheel_radius": 0.43}}, {}, {}, "surface", {},
        groups={"sweep": data}, provenance={"versions": {"numpy": "1"}, "code": "abc"},
    )  # fmt: skip


def test_signals_are_those_of_the_last_three_waves(explorer):
    made = explorer.compact(results())
    assert json.loads(json.dumps(made, allow_nan=False)) == made
    assert made["signals"][0][2][0] is None and made["failures"][0][2][0] == "too sharp"
    for w, wave in enumerate(WAVES):
        cell = made["signals"][1][0][w]
        x = cell["x"][0] + cell["x"][1] * np.arange(len(cell["counts"][0]))
        assert x[0] >= 3.0 + 5.0 * wave - 1e-6 and x[-1] <= 3.0 + 8.0 * wave + 1e-6
        assert x[-1] - x[0] > 2.9 * wave and 60 <= len(x) < 125
        for run, counts in enumerate(cell["counts"]):
            shown = cell["count"] * np.array(counts)
            assert shown == pytest.approx(force(x, wave, run), abs=1.0)


def test_errors_lie_where_they_belong_and_contours_between_them(explorer):
    made = explorer.compact(results())
    assert list(made["runs"]) == ["point"]
    assert made["refined"] == [] and "mesh size" in made["not_refined"]
    assert made["errors"][0][1][1][3] == pytest.approx(100 * error(WAVES[3], HEIGHTS[1]), rel=1e-3)
    text = explorer.script(made)
    shown = json.loads(text.removeprefix("const TRUST = ").removesuffix(";\n"))
    for level, lines in shown["contours"][0][0].items():
        assert lines, level
        for x, y in lines:  # the error is a power law: straight between the cells
            assert 100 * error(np.array(x), np.array(y)) == pytest.approx(float(level), rel=2e-3)
    low, high = shown["edges"][0][0], shown["edges"][0][-1]
    step = WAVES[1] / WAVES[0]
    assert (low, high) == pytest.approx((WAVES[0] / step**0.5, WAVES[-1] * step**0.5), rel=1e-3)


def test_results_without_signals_are_refused(explorer):
    bare = results()
    data = bare.groups["sweep"].drop_vars(["contact_force_smooth"])
    with pytest.raises(SystemExit, match="keep"):
        explorer.compact(replace(bare, groups={"sweep": data}))
