"""Contact status, stress below the patch, and the animation."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from contactstudy.figures.animation import frames_of, write_animations
from contactstudy.figures.patch import Touching
from contactstudy.halfspace.subsurface import stress_maxima
from contactstudy.plot.style import figure_style
from contactstudy.report.content import content
from contactstudy.solvers.patch_fields import instant_pressure
from contactstudy.study.kinds.passage.drawings import drawings

FRAMES = 3


@pytest.fixture
def full(results):
    """The made-up study with all that a run with instants and frames carries."""
    run = results.runs["surface"]
    pressure = run["pressure"].values
    run["contact_status"] = (("instant", "point"), (pressure > 0).astype(float), {"units": "1"})
    outside = (run["point_x"] ** 2 / 0.86 + run["point_y"] ** 2 / 0.6).values - 4e-5
    run["contact_pressure"] = (("instant", "contact_point"), pressure)
    run["contact_x"] = ("contact_point", run["point_x"].values)
    run["contact_y"] = ("contact_point", run["point_y"].values)
    run["point_area"] = ("point", np.where(run["point_y"] > 0, 2e-6, 1e-6))
    run["gap"] = (("instant", "point"), np.where(pressure > 0, -1e-7, outside), {"units": "m"})
    maxima = [stress_maxima(instant_pressure(run, k)) for k in range(len(pressure))]
    for i, name in enumerate(("von_mises", "maximum_shear")):
        for part in ("value", "x", "y", "depth"):
            key = name if part == "value" else f"{name}_{part}"
            run[key] = ("instant", [getattr(m[i], part) for m in maxima])
        run[name].attrs["poisson_ratio"] = 0.3
    share = np.linspace(0.5, 0.0, FRAMES)[:, None]
    run["frame_pressure"] = (("frame", "point"), share * pressure[0])
    at = np.linspace(10.0, 20.0, FRAMES)
    run = run.assign_coords(frame_position=("frame", at), frame_time=("frame", at / 83.0))
    results.runs["surface"] = run
    return results


def labels(figure):
    return [t for ax in figure.axes for t in (ax.get_xlabel(), ax.get_ylabel(), ax.get_title())]


def test_figures_of_the_patch(full):
    made = {d.name: d for d in drawings(full)}
    shear = full.runs["surface"]["maximum_shear"].values
    with figure_style():
        below, status = made["stress_below"].draw(), made["patch_status"].draw()
    assert {"Depth (mm)", "Von Mises (MPa)", "Maximum shear (MPa)", "Plane y = 0 mm"} <= set(
        labels(below)
    )
    marks = [t.get_text() for ax in below.axes if (g := ax.get_legend()) for t in g.get_texts()]
    assert len(marks) == 4 and all("MPa at" in text for text in marks)
    assert f"{shear.max() * 1e-6:.0f} MPa" in marks[2]
    assert below.axes[0].yaxis_inverted()
    assert "bending and support are not contained" in made["stress_below"].caption
    assert {"Contact points", "Along the rail (mm)"} <= set(labels(status))
    run, k = full.runs["surface"], int(np.argmax(shear))
    area = float((run["point_area"] * run["contact_status"])[:, k].sum()) * 1e6
    assert f"{area:.1f} mm²" in made["patch_status"].caption
    parts = {p["title"]: p for p in content(full, False)["results"]}
    files = [b["file"] for b in parts["Contact patch"]["blocks"] if "file" in b]
    (shear_row,) = [b["rows"] for b in parts["Contact patch"]["blocks"] if b["kind"] == "table"]
    assert len(shear_row) == len(shear) and shear_row[k][6] == f"{shear[k] * 1e-6:.0f}"
    assert files[:3] == [
        f"figures/{name}.pdf" for name in ("patch_pressure", "patch_status", "stress_below")
    ]


def test_animation(full, tmp_path):
    paths = [write_animations(full, tmp_path / name) for name in "ab"]
    assert [p.relative_to(tmp_path / "a").as_posix() for p in paths[0]] == ["figures/patch.gif"]
    assert paths[0][0].read_bytes() == paths[1][0].read_bytes()
    with Image.open(paths[0][0]) as image:
        assert image.n_frames == FRAMES
        frames = []
        for k in range(FRAMES):
            image.seek(k)
            frames.append(np.asarray(image.convert("RGB"), dtype=int))
    assert all(np.abs(a - b).max() > 50 for a, b in pairwise(frames))


def test_frames_are_mirrored(full):
    frames = frames_of(full.runs["surface"])
    assert frames.pressure.shape == (FRAMES, 25, 21)
    np.testing.assert_array_equal(frames.pressure, frames.pressure[:, :, ::-1])
    assert frames.pressure[0].max() == pytest.approx(
        0.5e-6 * full.runs["surface"]["pressure"].values[0].max()
    )


def test_no_frames_no_animation(bare, tmp_path):
    assert write_animations(bare, tmp_path) == []
    assert not list(tmp_path.iterdir())


def test_the_patch_is_what_touches_with_its_holes():
    closed = np.zeros((6, 5), dtype=bool)
    closed[1:5, 1:4] = True
    closed[2, 2] = False  # an open point among those that touch
    points = Touching(np.arange(6.0), np.arange(5.0), closed)
    inside = points.region(np.array([0.0, 0.6, 2.1, 4.4, 4.6]), np.array([0.4, 2.0, 3.6]))
    np.testing.assert_array_equal(
        inside,
        [[False] * 5, [False, True, True, True, False], [False] * 5],
    )
