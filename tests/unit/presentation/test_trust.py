"""The map of trust as a figure: what is read from the results."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from contactstudy.figures.trust import AMPLITUDE, SPEED, WAVELENGTH, drawings, trust_map
from contactstudy.figures.trust_levels import amplitude, limit_level
from contactstudy.study.loading import load_study
from contactstudy.study.results import StudyResults

WAVES, HEIGHTS, SPEEDS = [0.02, 0.1, 1.0], [2e-6, 2e-4], [20.0, 80.0]
PARTS = ["total", "irregularity"]


def coordinates():
    made = {}
    for key, values, unit in (
        (WAVELENGTH, WAVES, "m"), (AMPLITUDE, HEIGHTS, "m"), (SPEED, SPEEDS, "m/s"),
    ):  # fmt: skip
        made[key] = ((key,), np.array(values), {"units": unit, "long_name": key})
    return made


def results(companions=()):
    dims = [WAVELENGTH, AMPLITUDE, SPEED]
    shape = [len(WAVES), len(HEIGHTS), len(SPEEDS)]
    error = np.linspace(0.002, 0.2, 12).reshape(shape)
    error[0, 1] = np.nan  # too sharp
    data = xr.Dataset(coords=coordinates() | {"run": ["surface", "point"]})
    data.attrs = {"design": "sweep", "combine": "grid", "refined": ""}
    data["variant"] = (dims, np.full(shape, "x"))
    both = np.stack([np.full_like(error, np.nan), error], axis=-1)[..., None, None]
    both = np.broadcast_to(both, (*shape, 2, 1, 2))
    labels = {"signal": ["contact_force"], "part": PARTS}
    data = data.assign_coords(labels)
    data["relative_l2"] = ([*dims, "run", "signal", "part"], both)
    lost = np.where(np.isnan(error), np.nan, error > 0.15)
    data["contact_lost"] = ([*dims, "run"], np.stack([lost, lost], axis=-1))
    half = np.full((*shape, 2, 1), 5.8e-3)
    half = half[..., :1]
    data["static"] = ([*dims, "run", "signal"], half)
    return StudyResults(
        "map", "map", "", {"vehicle": {"wheel_radius": 0.43}}, {}, {}, "surface", {},
        groups={"sweep": data}, companions=tuple(companions),
    )  # fmt: skip


def companion(key, values, at, base):
    """Refines one key; differences `at` each value, the same at all waves and speeds."""
    dims = [WAVELENGTH, SPEED, key]
    data = xr.Dataset(coords={k: v for k, v in coordinates().items() if k != AMPLITUDE})
    data = data.isel({WAVELENGTH: [0, 2]})
    data = data.assign_coords({key: values, "signal": ["contact_force"], "part": PARTS})
    data.attrs = {"design": f"refine.{key}", "combine": "grid", "refined": key}
    shape = (2, len(SPEEDS), len(values), 1, 1, 2)
    spread = np.broadcast_to(np.array(at)[None, None, :, None, None, None], shape).copy()
    spread[1] *= 3.0  # at the longest wave
    data["from_finest"] = ([*dims, "run", "signal", "part"], spread)
    if isinstance(base, str):
        data[key].attrs["factor_of"] = base
    *tables, name = key.split(".")
    config = {name: base}
    for table in reversed(tables):
        config = {table: config}
    return replace(results(), name=name, config=config, groups={f"refine.{key}": data})


def test_the_references_own_error_is_the_sum_of_what_is_refined():
    mesh = companion("solid.mesh_size", [0.0028, 0.002, 0.0014], [0.03, 0.01, 0.0], 0.002)
    penalty = companion("solid.penalty", [1e16, 1e17], [0.002, 0.0], 1e16)
    found = trust_map(results([mesh, penalty]))
    # 1.2 % at 20 mm, three times that at 1 m; between them a power of the wavelength
    middle = 1.2 * 3.0 ** (np.log(0.1 / 0.02) / np.log(1.0 / 0.02))
    for k in range(2):
        assert found.own.values[k] == pytest.approx([1.2, middle, 3.6], rel=1e-12)
    assert found.refined == ("mesh size", "penalty")


def test_factors_of_the_journeys_step_are_refined_about_one():
    step = companion("runs.surface.time_step", [1.4, 1.0, 0.5], [0.02, 0.005, 0.0], "journey")
    found = trust_map(results([step]))
    assert found.own.values[0, [0, -1]] == pytest.approx([0.5, 1.5], rel=1e-12)
    assert found.refined == ("time step",)


def test_the_companion_refines_all_that_the_reference_is_made_of():
    designs = load_study("trust_reference").designs
    refined = {d.refined for d in designs}
    assert refined == {
        "solid.mesh_size", "solid.penalty", "solid.interface_modes", "solid.wheel_frequency",
        "runs.modal_surface.time_step",
    }  # fmt: skip
    (step,) = [d.series[d.refined] for d in designs if d.refined.startswith("runs")]
    assert step.factor_of == "journey" and 1.0 in step.coordinates


def test_the_map_is_drawn_and_says_what_is_in_it():
    (made,) = drawings(results())
    assert "Red: the reference loses contact" in made.caption
    assert "two crests" in made.caption
    assert "Hatched" not in made.caption  # no companion
    figure = made.draw()
    names = [t.get_text() for t in figure.axes[0].get_xticklabels()]
    assert "100 mm" in names and "1 m" in names


def test_axes_do_not_draw_what_the_map_shows():
    from contactstudy.figures import axes

    assert axes.drawings(results()) == []


def test_the_limit_is_an_amplitude():
    # 4.9 dB at 100 mm: 1 um 10^(4.9/20) sqrt 2
    wave, height = limit_level()
    assert height[wave == 0.1] == pytest.approx(np.sqrt(2) * 1.758e-6, rel=1e-3)
    assert amplitude(np.array([0.0])) == pytest.approx(np.sqrt(2) * 1e-6)
