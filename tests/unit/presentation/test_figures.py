"""Figures: axes, units, equal bytes, and optional data that is not there."""

from dataclasses import replace

import numpy as np
import pytest

from contactstudy.figures import model, write_figures
from contactstudy.figures.histories import shown_limit, swings_quickly
from contactstudy.figures.irregularity import irregularity_of, mean_level_difference, within
from contactstudy.figures.passing_components import all_passing
from contactstudy.figures.patch import bilinear, patch_of
from contactstudy.figures.press import own_give, power_law
from contactstudy.figures.signals import leaves_track, others
from contactstudy.irregularity.shown import SpectrumCurve
from contactstudy.plot.style import figure_style, legend_columns, run_styles, save
from contactstudy.plot.text import between, capital, exact, label, number, resolved, tick
from contactstudy.study.kinds.passage.drawings import drawings

LABELS = {
    "model": set(),
    "irregularity_spectrum": {"Angular wavenumber ω (rad/m)", "two-sided (m²/(rad/m))"},
    "irregularity_profile": {"Position X along the rail (m)", "(mm)"},
    "contact_force": {"Position X of the wheel (m)", "Force\n(kN)", "Difference\n(kN)"},
    "wheel_displacement": {"Displacement\nfrom rest\n(mm)", "Difference\n(mm)"},
    "wheel_acceleration": {"Acceleration\n(m/s²)", "Difference\n(m/s²)"},
    "rail_displacement": {"Displacement\n(mm)", "Difference\n(mm)"},
    "rail_acceleration": {"Acceleration\n(m/s²)", "Difference\n(m/s²)"},
    "third_octaves": {"Third-octave band centre (Hz)", "Force level (dB re 1 N)", "(dB)"},
    "patch_pressure": {"Along the rail (mm)", "Across the rail (mm)", "Pressure (MPa)"},
    "patch_history": {"Contact area (mm²)", "Peak pressure (MPa)"},
    "deformed_section": {"Across the rail y (mm)", "less the rail's mean (µm)"},
}


@pytest.fixture
def by_name(results):
    return {made.name: made for made in drawings(results)}


def test_every_figure_of_a_full_study_is_there_with_its_units(by_name):
    assert set(by_name) == set(LABELS)
    with figure_style():
        for name, wanted in LABELS.items():
            figure = by_name[name].draw()
            shown = [t for axes in figure.axes for t in (axes.get_xlabel(), axes.get_ylabel())]
            for text in wanted:
                assert any(text in label for label in shown), (name, text, shown)


def test_spectrum_has_logarithmic_axes_and_a_second_axis_of_wavelengths(by_name):
    with figure_style():
        figure = by_name["irregularity_spectrum"].draw()
        figure.draw_without_rendering()
    axes = figure.axes[0]
    assert axes.get_xscale() == axes.get_yscale() == "log"
    (second,) = axes.child_axes
    assert second.get_xlabel() == "Wavelength (m)"
    low, high = axes.get_xlim()
    assert sorted(second.get_xlim()) == pytest.approx([2 * np.pi / high, 2 * np.pi / low])


def test_smooth_companion_has_passing_figures_and_no_irregularity(results):
    names = {made.name for made in drawings(results.companions[0])}
    assert {"smooth_force", "passing_amplitudes"} <= names
    assert not any(name.startswith("irregularity") for name in names)


def test_passing_amplitudes_are_those_put_into_the_signal(results):
    found = all_passing(results.companions[0])
    for k, p in enumerate(found.values()):
        assert p.amplitudes[0] == pytest.approx(350.0 * (1 + 0.1 * k), rel=2e-3)
        assert p.amplitudes[3] == pytest.approx(40.0 * (1 + 0.1 * k), rel=2e-3)
        assert p.amplitudes[[1, 2, 4]] == pytest.approx(0.0, abs=1.0)


def test_missing_optional_data_leaves_figures_out(bare):
    names = [made.name for made in drawings(bare)]
    signals = [
        "model",
        "contact_force",
        "wheel_displacement",
        "wheel_acceleration",
        "rail_displacement",
        "rail_acceleration",
        "third_octaves",
    ]
    assert names == signals


def test_second_writing_gives_equal_bytes(by_name, tmp_path):
    for name in ("irregularity_spectrum", "patch_pressure", "patch_history"):
        written = []
        for folder in ("a", "b"):
            with figure_style():
                written.append(save(by_name[name].draw(), tmp_path / folder, name))
        assert [p.name for p in written[0]] == [f"{name}.pdf", f"{name}.png"]
        for one, other in zip(*written, strict=True):
            assert one.read_bytes() == other.read_bytes(), one.name
            assert b"CreationDate" not in one.read_bytes()


def test_writing_makes_every_figure_twice_and_nothing_else(bare, tmp_path):
    keep = ["position", "contact_force"]
    runs = {name: bare.runs[name][keep] for name in ("point", "tangent")}
    small = type(bare)(**{**vars(bare), "runs": runs})
    written = write_figures(small, tmp_path)
    assert [p.name for p in written] == [
        f"{name}.{ending}"
        for name in ("model", "contact_force", "third_octaves")
        for ending in ("pdf", "png")
    ]
    assert sorted(p.name for p in (tmp_path / "figures").iterdir()) == sorted(
        p.name for p in written
    )


def test_ticks_of_logarithmic_axes_are_no_markup(by_name, tmp_path):
    # a user's text is drawn as it is, and so is a tick
    with figure_style():
        figure = by_name["irregularity_spectrum"].draw()
        save(figure, tmp_path, "ticks")
    axes = figure.axes[0]
    texts = [t.get_text() for t in (*axes.get_xticklabels(), *axes.get_yticklabels())]
    assert "10⁻⁹" in texts and {"0.1", "1", "10"} <= set(texts)
    assert not any("$" in text for text in texts)
    (second,) = axes.child_axes
    assert not any("$" in t.get_text() for t in second.get_xticklabels(which="both"))
    assert [tick(v) for v in (0.02, 3e-5, 2e4, 1.0, 1e-3)] == [
        "0.02", "3·10⁻⁵", "2·10⁴", "1", "0.001",
    ]  # fmt: skip


def test_half_model_pressure_is_mirrored(results):
    patch = patch_of(results.runs["surface"])
    assert patch is not None
    assert patch.y.min() == -patch.y.max()
    for x, y, p in zip(patch.x[:40], patch.y[:40], patch.pressure[:40], strict=True):
        twin = np.isclose(patch.x, x) & np.isclose(patch.y, -y)
        assert patch.pressure[twin] == pytest.approx(p)


def test_captions_change_with_the_data(results, by_name):
    run = results.runs["tangent"]
    louder = run.assign(contact_force=run["contact_force"] * 1.05)
    other = type(results)(**{**vars(results), "runs": {**results.runs, "tangent": louder}})
    changed = {made.name: made.caption for made in drawings(other)}
    assert changed["contact_force"] != by_name["contact_force"].caption
    assert "largest for tangent" in changed["contact_force"]


def test_signals_of_a_run_the_other_way_are_drawn_and_not_subtracted(results):
    runs = dict(results.runs)
    back = runs["tangent"].assign_coords(position=36.0 - runs["tangent"]["position"])
    runs["tangent"] = back.assign_attrs(travel="backward", start=6.0)
    other = type(results)(**{**vars(results), "runs": runs})
    assert others(other) == ["hertz_timoshenko", "point"]
    assert others(type(results)(**{**vars(results), "runs": {}})) == []  # a sweep
    found = {made.name: made for made in drawings(other)}
    assert "tangent" not in found["third_octaves"].caption
    with figure_style():
        whole, below, *_ = found["contact_force"].draw().axes
    assert len(whole.lines) == 4
    seen = [line for line in below.lines if line.get_visible()]
    assert len(seen) + len(below.collections) == 3  # zero, and two differences


def test_figures_end_where_the_track_does(results):
    config = results.config | {"track": results.config["track"] | {"length": 20.0}}
    short = type(results)(**{**vars(results), "config": config})
    assert leaves_track(short) == 20.0 and leaves_track(results) is None
    found = {made.name: made for made in drawings(short)}
    with figure_style():
        assert found["contact_force"].draw().axes[0].get_xlim() == (6.0, 20.0)


def test_the_travelled_stretch_ends_where_the_profile_does(results):
    profile = irregularity_of(results).profile
    assert within((6.0, 715.0), profile) == (6.0, pytest.approx(35.95))
    assert within((-3.0, 30.0), profile) == (0.0, 30.0)
    assert within(None, profile) is None and within((0.0, 715.0), profile) is None


def test_a_power_law_is_recovered_from_its_points():
    x = np.array([1e-5, 2e-5, 4e-5, 8e-5])
    force, at = 3e12 * x**1.7, np.array([1.5e-5, 5e-5])
    assert power_law(force, x, at) == pytest.approx(3e12 * at**1.7)


def test_the_patch_of_the_reference_is_drawn_on_top_and_overlap_told_once(results):
    runs = {"surface": results.runs["surface"], "other": results.runs["surface"]}
    runs = {k: run.assign(penetration=run["irregularity"] * 0 + 2e-9) for k, run in runs.items()}
    made = {d.name: d for d in drawings(type(results)(**{**vars(results), "runs": runs}))}
    caption = made["patch_history"].caption
    assert caption.count("After the fade-in") == caption.count("overlap by at most 2.00 nm") == 1
    with figure_style():
        reference, other = made["patch_history"].draw().axes[0].lines
    assert reference.get_zorder() > other.get_zorder()


def test_long_wavelengths_beside_an_axis_are_plain_numbers(results, by_name):
    with figure_style():
        top = by_name["third_octaves"].draw().axes[0]
    (second,) = top.child_axes
    texts = [t.get_text() for t in second.get_xticklabels()]
    assert texts and not any("e" in text for text in texts)
    for text, f in zip(texts, second.get_xticks(), strict=True):
        assert float(text) == pytest.approx(300 / 3.6 / f, rel=0.05)


def test_level_difference_of_spectra_is_the_factor_between_them():
    w = np.geomspace(0.1, 10, 50)
    one = SpectrumCurve("one", w, 1e-7 / w**2, (0.2, 8.0))
    half = SpectrumCurve("half", w, 0.5e-7 / w**2, (0.1, 5.0))
    mean, low, high = mean_level_difference(half, one)
    assert (mean, low, high) == pytest.approx((10 * np.log10(0.5), 0.2, 5.0))


def test_runs_differ_in_dashes_as_well_as_in_colour():
    styles = run_styles([f"run{i}" for i in range(12)], "run0")
    assert styles["run0"].color == "#000000"
    pairs = {(s.color, str(s.linestyle)) for s in styles.values()}
    assert len(pairs) == 12
    assert len({str(styles[f"run{i}"].linestyle) for i in range(1, 7)}) == 6


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1093.7, "1090"),
        (-0.00123, "−0.00123"),
        (1.5e-7, "1.50·10⁻⁷"),
        (0.0, "0"),
        (99.96, "100"),
        (12345.6, "12300"),
        (float("nan"), "not finite"),
    ],
)
def test_number_to_three_digits(value, text):
    assert number(value) == text


def test_a_range_without_width_is_a_value():
    assert between(46.6001, 46.6002) == "stays at 46.6"
    assert between(-1.5, 17.68) == "lies between −1.50 and 17.7"


def test_given_values_lose_trailing_zeros():
    assert [exact(v) for v in (6.0, 83.333333, 1e11, 0.05)] == ["6", "83.3333", "1·10¹¹", "0.05"]


def test_symbols_stay_as_they_are():
    assert label("hertz_euler") == "hertz euler" and label("k_r_sweep") == "k_r sweep"
    assert label("k_r") == "k_r" and capital("k_r of point") == "k_r of point"
    assert capital("speed") == "Speed"


def test_the_reference_is_drawn_on_top(results, by_name):
    with figure_style():
        for name in ("contact_force", "third_octaves"):
            axes = by_name[name].draw().axes[0]
            order = {line.get_label(): line.get_zorder() for line in axes.lines}
            reference = order.pop("surface (reference)")
            assert all(reference > z for z in order.values() if z is not None), name


def test_one_loud_run_does_not_fill_the_panel_of_differences(results):
    run = results.runs["tangent"]
    rng = np.random.default_rng(1)
    loud = run["contact_force"] + 30e3 * rng.standard_normal(run.sizes["time"])
    other = type(results)(
        **{**vars(results), "runs": {**results.runs, "tangent": run.assign(contact_force=loud)}}
    )
    made = {d.name: d for d in drawings(other)}["contact_force"]
    with figure_style():
        below = made.draw().axes[1]
    colours = {line.get_color() for line in below.lines}
    assert run_styles(list(other.runs), other.reference)["tangent"].color not in colours
    assert below.get_ylim()[1] < 30.0
    assert "tangent is left out of the panel" in made.caption


@pytest.mark.parametrize(
    ("largest", "limit"), [([10.0, 9.0], None), ([100.0, 4.0, 1.0], 5.0), ([3.0], None)]
)
def test_where_the_panel_of_differences_ends(largest, limit):
    assert shown_limit(largest) == limit


def test_a_quick_swing_is_told_from_a_slow_one():
    x = np.linspace(0, 24, 5000)
    assert swings_quickly(np.sin(2 * np.pi * x / 0.1))
    assert not swings_quickly(np.sin(2 * np.pi * x / 1.5))
    assert not swings_quickly(np.zeros(5000)) and not swings_quickly(np.arange(20.0))


def test_bilinear_field_between_nodes():
    x, y = np.array([0.0, 2.0, 3.0]), np.array([-1.0, 1.0])
    plane = 2.0 * x + 3.0 * y[:, None] + x * y[:, None]
    fine_x, fine_y, fine = bilinear(x, y, plane, 4)
    assert fine.shape == (5, 9) and fine_x[4] == 2.0
    np.testing.assert_allclose(fine, 2 * fine_x + 3 * fine_y[:, None] + fine_x * fine_y[:, None])


def test_give_of_the_bodies_beside_hertz():
    force = np.linspace(20e3, 120e3, 7)
    hertz = (force / 9.2e10) ** (2 / 3)
    assert own_give(force, hertz + 2e-10 * force, hertz) == pytest.approx(2e-10, rel=1e-12)


def test_a_picture_of_the_model(results):
    (made,) = model.drawings(results)
    with figure_style():
        texts = {t.get_text() for t in made.draw().axes[0].texts}
    assert {"X", "Y", "Z", "rail", "pad", "sleeper", "wheel", "300 km/h", "0.6 m"} <= texts
    assert {"point contact", "surface contact"} <= texts
    assert "an irregular rail on discrete supports" in made.caption
    config = {**results.config, "irregularity": {"spectrum": "smooth", "rail_defect": "none"}}
    (made,) = model.drawings(replace(results, config=config))
    with figure_style():
        smooth = {t.get_text() for t in made.draw().axes[0].texts}
    assert texts - smooth == {"$r_v(X)$"} and "a smooth rail" in made.caption


def test_a_legend_is_as_wide_as_its_columns():
    """Columns are as wide as their longest entry, with 9 characters beside it, 90 in all."""
    assert legend_columns(["left wheel", "right wheel", "right wheel, further patches"]) == 3
    assert legend_columns(["a" * 36] * 4) == 2
    assert legend_columns(["a" * 37] * 4) == 1


@pytest.mark.parametrize(
    ("value", "step", "text"),
    [
        (1.0512, 0.0059, "1.0512"),
        (35.4, 1.2, "35.4"),
        (0.0, 0.1, "0"),
        (94.5, float("nan"), "94.5"),
    ],
)
def test_numbers_tell_the_differences_between_them(value, step, text):
    assert resolved(value, step) == text
