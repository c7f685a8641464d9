"""The table [wheelset] of a study: profiles and position, whole sections, what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.geometry.points import contact_points
from contactstudy.solids.cell import section_of
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import contact_zone, geometry
from contactstudy.study.loading import load_study

WHOLE = ["solid.section=whole"]


def loaded(*overrides: str):
    return load_study("s1002_inclined", overrides)


def refused(*overrides: str) -> str:
    with pytest.raises(InputError) as error:
        loaded(*overrides)
    return "\n".join(error.value.problems)


def test_whole_section_has_its_own_defaults_and_keeps_given_ones():
    solid = loaded().solid
    assert (solid.section, solid.interface_modes, solid.contact_half_width) == ("whole", 20, 0.012)
    assert loaded("solid.interface_modes=22").solid.interface_modes == 22


def test_inclination_as_ratio_or_angle():
    ratio = loaded("wheelset.rail_inclination=1:20").wheelset.rail_inclination
    assert ratio == pytest.approx(math.atan(0.05))
    angle = loaded("wheelset.rail_inclination=25 mrad").wheelset.rail_inclination
    assert angle == pytest.approx(0.025)


def test_centred_position_follows_from_gauge_and_flange_backs():
    """Tape circle 680 + 70 mm from the middle; gauge point of the inclined rail at 717.5 mm."""
    placed = geometry(loaded())
    assert placed is not None
    # the gauge point, 36 mm beside and 14 mm below the crown, turned by 1:40; the depth counts
    # from the highest point, 0.09 mm above the crown, where the head is 0.1 mm narrower
    gauge_point = -36.0 * math.cos(0.025) + 14.0 * math.sin(0.025)
    assert placed.pose.lateral * 1e3 == pytest.approx(750.0 - 717.5 + gauge_point, abs=0.15)
    assert placed.pose.roll == pytest.approx(0.0, abs=1e-9)


def test_shift_moves_the_wheels_of_the_two_sides_apart():
    shifted = [
        geometry(loaded("wheelset.lateral_shift=3 mm", f"wheelset.side={side}"))
        for side in ("left", "right")
    ]
    centred = geometry(loaded())
    left, right = (g.pose.lateral - centred.pose.lateral for g in shifted)
    # the roll at rest swings the wheels' lowest points sideways about the axle
    swing = 0.43 * shifted[1].pose.roll
    assert right == pytest.approx(3e-3 + swing, abs=1e-6)
    assert left == pytest.approx(-3e-3 - swing, abs=1e-6)
    assert 0 < swing < 0.2e-3


@pytest.mark.parametrize("shift", [-8, 0, 2, 4, 5])
def test_fine_zones_lie_over_each_other(shift):
    """From the tread's outer end to tread and flange root at once (5 mm)."""
    study = loaded(f"wheelset.lateral_shift={shift} mm")
    zone, placed = contact_zone(study), geometry(study)
    half = study.solid.contact_half_width
    s, arc = placed.overlap(40e-6)
    assert zone.wheel - half < s.min() and s.max() < zone.wheel + half
    assert zone.rail[0] < arc.min() and arc.max() < zone.rail[1]
    wheel = build.wheel_recipe(study)
    assert not wheel.symmetric and wheel.contact_centre == zone.wheel
    # the meshed running surface holds the foot of every point of the wheel's zone
    points = contact_points(placed, wheel.x, wheel.y)
    section, _, rows = section_of(build.recipe(study))
    assert not section.symmetric
    assert rows.surface_arc.min() < points.arc.min() < points.arc.max() < rows.surface_arc.max()


def test_hertz_takes_the_curvatures_at_the_touch():
    placed = geometry(loaded())
    along, across = placed.relative_radii()
    assert along == pytest.approx(0.43, rel=0.01)
    # R300 of the crown against the hollow tread: z'' of EN 13715's polynomial B [1/mm]
    s = placed.touch.wheel_s * 1e3
    hollow = 2 * 1.565681624e-3 - 6 * 2.810427944e-5 * s + 12 * 5.844240864e-8 * s**2
    hollow -= 20 * 1.562379023e-8 * s**3
    assert 1 / across == pytest.approx(1 / 0.3 - 1e3 * hollow, rel=0.01)
    cone = geometry(loaded("wheelset.wheel_profile=cone"))
    assert cone.relative_radii()[1] == pytest.approx(0.3, rel=1e-6)


@pytest.mark.parametrize(
    ("overrides", "parts"),
    [
        (["solid.section=half"], ["wheelset.wheel_profile: applies only with solid.section"]),
        (["wheelset.wheel_profile=S1003"], ["wheelset.wheel_profile", "S1003", "S1002"]),
        (["wheelset.rail_inclination=1:2"], ["wheelset.rail_inclination", "1:5"]),
        (["wheelset.lateral_shift=80 mm"], ["wheelset.lateral_shift", "80 mm", "0.05 m"]),
        (["solid.interface_modes=5"], ["solid.interface_modes", "at least 6"]),
        (["wheelset.rail_profile=worn.csv"], ["wheelset.rail_profile", "worn.csv"]),
    ],
)
def test_impossible_positions_name_the_key(overrides, parts):
    message = refused(*overrides)
    for part in parts:
        assert part in message


def test_worn_wheel_from_a_file_beside_the_study(tmp_path):
    from contactstudy.profiles.named import wheel_curve

    s = np.linspace(-0.030, 0.030, 241)
    y, z = wheel_curve("S1002").point(s).T
    table = "\n".join(f"{a:.6f},{b:.6f}" for a, b in zip(y * 1e3, z * 1e3, strict=True))
    (tmp_path / "worn.csv").write_text(f"y [mm],z [mm]\n{table}\n", encoding="utf-8")
    (tmp_path / "own.toml").write_text(
        '[solid]\nsection = "whole"\n[wheelset]\nwheel_profile = "worn.csv"\n'
        '[runs.a]\nsolver = "surface"\n',
        encoding="utf-8",
    )
    own, drawn = (geometry(load_study(p)) for p in (tmp_path / "own.toml", "s1002_inclined"))
    assert own.touch.wheel_s == pytest.approx(drawn.touch.wheel_s, abs=0.3e-3)
    assert own.pose.lateral == pytest.approx(drawn.pose.lateral, abs=1e-9)


def test_a_wheelset_that_has_climbed_its_rail_is_refused():
    """At -40 mm the left wheel's flange runs on the rail's head."""
    text = refused("wheelset.lateral_shift=-40 mm")
    assert text.startswith("wheelset.lateral_shift = -40 mm with a yaw of 0 mrad: the left wheel")
    assert "it has derailed" in text


def test_a_wheelset_too_narrow_for_its_track_names_the_keys():
    text = refused("wheelset.gauge=2 m")
    assert "wheelset.gauge = 2 m" in text and "wheelset.flange_backs = 1.36 m" in text
    assert "inside the rails' crowns; must be at most 50 mm" in text


def test_the_zone_follows_the_rail_as_it_gives_way_sideways():
    """The drawn bodies touch at the gauge corner alone; pushed aside by a fraction of a millimetre
    the rail meets the tread as well, and both places lie in the zone."""
    study = loaded("wheelset.lateral_shift=5.5 mm")
    zone, placed = contact_zone(study), geometry(study)
    half = study.solid.contact_half_width
    corner, tread = (placed.moved((to - 5.5) * 1e-3).touch for to in (5.3, 4.9))
    for touch in (corner, tread):
        assert abs(touch.wheel_s - zone.wheel) < half
        assert zone.rail[0] < touch.arc < zone.rail[1]
    assert tread.arc - corner.arc > 0.01


@pytest.mark.parametrize("shift", [6, 6.5, 8, 12])
def test_steep_contact_that_pushes_the_rail_far_aside_is_refused(shift):
    study = loaded(f"wheelset.lateral_shift={shift} mm")
    with pytest.raises(InputError, match=r"lateral_shift = .* allowed is 1 mm"):
        contact_zone(study)


def test_contact_ahead_of_the_fine_zone_names_the_key():
    """With yaw the gauge corner touches ahead of the wheel's lowest point."""
    study = loaded("wheelset.lateral_shift=5.5 mm", "wheelset.yaw=25 mrad")
    short = replace(study, solid=replace(study.solid, mesh_size=1e-3, contact_half_length=1e-3))
    with pytest.raises(InputError, match=r"solid.contact_half_length = 1 mm must be larger"):
        contact_zone(short)
