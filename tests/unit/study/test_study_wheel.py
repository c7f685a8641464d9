"""Study keys of the wheel: its section file, and how it moves in each run."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.wheel_file import wheel_sections
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.loading import load_study
from contactstudy.study.plan import plan_study

STUDY = """
[irregularity]
spectrum = "smooth"
[solid]
wheel = "quasi-static"
{solid}
[runs.a]
solver = "surface"
wheel = "{model}"
[runs.b]
solver = "surface"
[runs.c]
solver = "point"
k_r = "tangent"
"""


def written(folder: Path, model: str = "modal", solid: str = "") -> Path:
    path = folder / "study.toml"
    path.write_text(STUDY.format(model=model, solid=solid))
    return path


def own_wheel(folder: Path, diameter: float = 860.0, width: float = 65.0) -> None:
    text = wheel_sections()["straight_860"].read_text()
    text = text.replace("tread_diameter = 860.0", f"tread_diameter = {diameter}")
    (folder / "mine.toml").write_text(text.replace("outside = 65.0", f"outside = {width}"))


def test_a_run_has_its_own_wheel(tmp_path: Path) -> None:
    study = load_study(written(tmp_path))
    assert [study.wheel(run) for run in "abc"] == ["modal", "quasi-static", "quasi-static"]
    bodies = {run: [body.name for body in contact.bodies(study, run)] for run in "abc"}
    assert bodies["a"] == ["rail", "wheel", "wheel modes"]
    assert bodies["b"] == ["rail", "wheel"] and bodies["c"] == ["rail", "wheel", "press"]
    assert study.config()["runs"]["b"]["wheel"] == "quasi-static"
    rigid = load_study(written(tmp_path, "rigid"))
    assert [body.name for body in contact.bodies(rigid, "a")] == ["rail"]
    assert not build.wheel(rigid, "a").flexibility.any()


def test_modes_go_with_a_finer_ring(tmp_path: Path) -> None:
    modal, plain = (
        build.wheel_recipe(load_study(written(tmp_path, m))) for m in ("modal", "rigid")
    )
    assert np.diff(modal.angles).max() < 0.4 * np.diff(plain.angles).max()
    recipe = build.modes_recipe(load_study(written(tmp_path, solid='wheel_frequency = "2 kHz"')))
    assert recipe.highest == 2000.0 and recipe.wheel == modal


def test_own_section_file(tmp_path: Path) -> None:
    own_wheel(tmp_path)
    path = written(tmp_path, solid='wheel_section = "mine.toml"')
    study = load_study(path)
    assert (
        build.wheel_recipe(study).dimensions
        == build.wheel_recipe(load_study(written(tmp_path))).dimensions
    )
    written(tmp_path, solid='wheel_section = "mine.toml"')
    before = plan_study(load_study(path), tmp_path)
    assert before.inputs.config["solid"]["wheel_section"] == "mine.toml"
    own_wheel(tmp_path, width=60.0)
    after = plan_study(load_study(path), tmp_path)
    for one, other in zip(before.pieces, after.pieces, strict=True):
        assert one.label == other.label and one.key != other.key
    assert [piece.label for piece in after.pieces] == list("abc")
    assert build.wheel_recipe(load_study(path)).dimensions.rim_outside == 0.060


def test_wrong_wheels_at_once(tmp_path: Path) -> None:
    own_wheel(tmp_path, diameter=100.0, width=-5.0)
    solid = 'wheel_section = "mine.toml"\nwheel_frequency = "-1 Hz"'
    with pytest.raises(InputError) as error:
        load_study(written(tmp_path, "elastic", solid))
    text = "\n".join(error.value.problems)
    assert "solid.wheel_frequency" in text and '"quasi-static"' in text.replace("'", '"')
    with pytest.raises(InputError) as error:
        load_study(written(tmp_path, solid='wheel_section = "mine.toml"'))
    text = "\n".join(error.value.problems)
    assert text.count("solid.wheel_section") == len(error.value.problems) >= 2
    own_wheel(tmp_path, diameter=920.0)
    with pytest.raises(InputError, match=r"vehicle.wheel_radius.*0\.46 m"):
        load_study(written(tmp_path, solid='wheel_section = "mine.toml"'))
    with pytest.raises(InputError, match="straight_860"):
        load_study(written(tmp_path, solid='wheel_section = "round"'))
    with pytest.raises(InputError, match="wheel_radius"):
        load_study(written(tmp_path), ['vehicle.wheel_radius="0.15 m"'])
