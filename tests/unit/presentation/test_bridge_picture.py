"""The picture of the bridge with the train on it, and its animation."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from contactstudy.figures.bridge_picture import drawings, write_animation
from contactstudy.figures.bridge_scene import Scene, _rounded
from contactstudy.figures.resolved_track import bridge_of
from contactstudy.plot.style import figure_style
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.results import StudyResults


@pytest.fixture(scope="module", params=["forward", "backward"])
def results(request):
    made = parse_study(
        "picture",
        {
            "track": {"structure": "bridge", "spans": ["2 x 15 m"], "approach_before": 12.0,
                      "approach_behind": 12.0, "animation_frames": 8},
            "vehicle": {"type": "train", "cars": ["s300"]},
            "journey": {"speed": 60.0, "time_step": 2e-3},
            "irregularity": {"spectrum": "german_low"},
            "runs": {"one": {"solver": "point", "k_r": 1e9, "travel": request.param}},
        },
    )  # fmt: skip
    runs = {"one": execute_run(made, "one")}
    return StudyResults("picture", "P", "", made.config(), made.units(), runs, None, {})


def test_the_scene_shows_the_bridge_and_the_train_where_they_are(results):
    run = results.runs["one"]
    scene = Scene(run, parse_bridge(results))
    with figure_style():
        scene.draw()
    k = int(scene.worst)
    up = run.frame_displacement.sel(axis="Z").values
    assert scene.up[k, scene.node] == up[:, run.node_part.values == 1].min()
    # dots on the rail, which between two seats bends a little further down under a wheel
    x, z = scene.dots.get_data()
    assert x.tolist() == sorted(run.position.values[:, scene.steps[k]])
    (on,) = np.nonzero((x > 12.0) & (x < 42.0))
    assert len(on) >= 4
    x, z = x[on], z[on]
    rail = run.node_part.values == 0
    there = np.interp(x, run.node_x.values[rail], 1e3 * up[k, rail])
    np.testing.assert_allclose(z, there, atol=0.15 * np.abs(there).max())
    x, _ = scene.dots.get_data()
    (body,) = [path.vertices for path in scene.bodies.get_paths()]
    # the wheels are below their car
    assert body[:, 0].min() < x.min() and x.max() < body[:, 0].max()
    assert np.ptp(body[:, 0]) == pytest.approx(25.0 - 0.5)


def test_a_short_span_leaves_room_on_the_page(results):
    track = dict(results.config["track"]) | {"spans": [5.0] * 6}
    bridge = bridge_of(track)
    with figure_style():
        figure = Scene(results.runs["one"], bridge).draw()
    assert figure.get_figheight() < 6.0  # inch; the page holds 9.7 with heading and caption


def parse_bridge(results):
    return bridge_of(results.config["track"])


def test_the_animation_moves_and_is_the_same_each_time(results, tmp_path):
    first, second = (write_animation(results, tmp_path / name)[0] for name in "ab")
    assert first.read_bytes() == second.read_bytes()
    with Image.open(first) as gif:
        assert gif.n_frames == 8
        pictures = []
        for k in range(8):
            gif.seek(k)
            pictures.append(np.asarray(gif.convert("L"), dtype=float))
    assert all(np.abs(a - b).max() > 50 for a, b in pairwise(pictures))


def test_caption(results):
    (made,) = drawings(results)
    run = results.runs["one"]
    down = 1e3 * float(run.frame_displacement.sel(axis="Z").values[:, run.node_part == 1].min())
    assert f"−{abs(down):.3g}"[:4] in made.caption
    assert "figures/bridge_passage.gif" in made.caption


def test_enlargement_is_a_round_number():
    assert [_rounded(f) for f in (0.3, 1.0, 4.9, 5.0, 730.0)] == [1.0, 1.0, 2.0, 5.0, 500.0]
