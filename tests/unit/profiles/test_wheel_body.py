"""Cross-section file of a wheel: the shipped one, and everything wrong with one at once."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.profiles.wheel_file import wheel_dimensions, wheel_sections

CURVED = """
name = "curved"
tread_diameter = 920
bore_diameter = 180
[rim]
inside = -70
outside = 65
thickness = 65
[web]
station = [0, 0.5, 1]
offset = [30, 0, -10]
thickness = [40, 20, 30]
[hub]
inside = -60
outside = 110
diameter = 250
"""


def test_the_shipped_wheel_is_the_default() -> None:
    assert list(wheel_sections()) == ["straight_860"]
    assert repr(wheel_dimensions()) == repr(WheelDimensions())


def test_own_file_with_a_curved_web(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(CURVED)
    d = wheel_dimensions(str(file))
    assert d.radius == pytest.approx(0.46) and d.hub_radius == pytest.approx(0.125)
    inside, outside = d.web([0.125, 0.5 * (0.125 + 0.395), 0.395])
    np.testing.assert_allclose(0.5 * (inside + outside), [0.030, 0.0, -0.010], atol=1e-12)
    np.testing.assert_allclose(outside - inside, [0.040, 0.020, 0.030], atol=1e-12)


def test_another_radius_stretches_the_web() -> None:
    d = WheelDimensions().with_radius(0.46)
    assert d.inner_radius == pytest.approx(0.40)
    assert d.rim_thickness == 0.060 and d.hub_radius == 0.130


def test_all_errors_of_a_file_at_once(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(
        CURVED.replace('name = "curved"', "diameter = 3")
        .replace("bore_diameter = 180", 'bore_diameter = "wide"')
        .replace("thickness = 65", "")
        .replace("offset = [30, 0, -10]", "offset = 30")
    )
    with pytest.raises(InputError) as error:
        wheel_dimensions(str(file))
    text = "\n".join(error.value.problems)
    for part in ("diameter: unknown key", "bore_diameter", "rim.thickness", "web.offset"):
        assert part in text
    assert len(error.value.problems) == 4
    assert all("bad.toml" in problem for problem in error.value.problems)


def test_impossible_dimensions_at_once(tmp_path: Path) -> None:
    file = tmp_path / "odd.toml"
    text = CURVED.replace("[0, 0.5, 1]", "[0, 1, 0.5]").replace("inside = -60", "inside = 60")
    file.write_text(text.replace("bore_diameter = 180", "bore_diameter = 300"))
    with pytest.raises(InputError) as error:
        wheel_dimensions(str(file))
    text = "\n".join(error.value.problems)
    assert "increase from 0 to 1" in text and "bore_radius" in text and "hub" in text


def test_unknown_names_and_files(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="straight_860"):
        wheel_dimensions("round_900")
    with pytest.raises(InputError, match="there is no such file"):
        wheel_dimensions(str(tmp_path / "none.toml"))
    broken = tmp_path / "broken.toml"
    broken.write_text("[rim")
    with pytest.raises(InputError, match="is not a TOML file"):
        wheel_dimensions(str(broken))
