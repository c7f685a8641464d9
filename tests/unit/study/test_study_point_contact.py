"""Contact of point runs in a study: what the keys make, and constants against their formulas."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.contact.filters import PatchMean, Trajectory
from contactstudy.contact.laws import HertzSpring, LinearSpring, PressSpring
from contactstudy.contact.patch_laws import FollowingPatch, WinklerBedding
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.kinds.passage.execution import execute_batch, execute_run
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.loading import load_study

STUDY = """
[irregularity]
band = ["150 rad/m", "300 rad/m"]
roughness = 1e-4
terms = 20
[track]
length = "6 m"
[journey]
from = "2.4 m"
to = "3 m"
fade_in = "0.2 m"
time_step = "0.1 ms"
[solid]
mesh_size = "4 mm"
[runs.one]
solver = "point"
"""


def study(folder: Path, switches: str = "", **keys: str) -> Study:
    path = folder / "study.toml"
    lines = [f'{key} = "{value}"' for key, value in keys.items()]
    path.write_text("\n".join([STUDY, *lines, *(f"{s} = true" for s in switches.split())]))
    return load_study(path)


def closed(study: Study):  # type: ignore[no-untyped-def]
    return hertz_contact(study.vehicle.static_load, contact_modulus(), 0.43, 0.30)


def test_multiples_of_closed_stiffnesses(tmp_path: Path) -> None:
    for given, factor, name in (
        ("hertz_tangent", 1.0, "tangent_stiffness"),
        ("2.5 x hertz_tangent", 2.5, "tangent_stiffness"),
        ("1e3x hertz_secant", 1e3, "secant_stiffness"),
    ):
        one = study(tmp_path, k_r=given)
        law = contact.contact_law(one, "one")
        assert isinstance(law, LinearSpring)
        assert law.stiffness == pytest.approx(factor * getattr(closed(one), name), rel=1e-12)


def test_filters_of_the_ellipse(tmp_path: Path) -> None:
    one = study(tmp_path, k_r="hertz_tangent", contact_filter="patch")
    found = contact.contact_filter(one, "one")
    assert isinstance(found, PatchMean)
    # standard deviation of the plain mean over 2a
    spread = np.sqrt(found.weights @ found.offsets**2)
    assert spread == pytest.approx(closed(one).semi_axis_x / np.sqrt(3), rel=1e-12)
    assert one.config()["runs"]["one"]["patch_weight"] == "hertz"
    round_wheel = contact.contact_filter(study(tmp_path, contact_filter="trajectory"), "one")
    assert round_wheel == Trajectory(0.43)


def test_laws_along_the_patch(tmp_path: Path) -> None:
    one = study(tmp_path, law="hertz", contact_filter="bedding")
    h = closed(one)
    law = contact.contact_law(one, "one")
    assert isinstance(law, WinklerBedding) and contact.contact_filter(one, "one") is None
    assert law.approach == pytest.approx(h.approach) and law.half_length == h.semi_axis_x
    one = study(tmp_path, law="hertz", contact_filter="patch", patch_filter="following")
    following = contact.contact_law(one, "one")
    assert isinstance(following, FollowingPatch) and contact.contact_filter(one, "one") is None
    assert following.law == HertzSpring(h.stiffness)


def test_the_press_in_all_its_uses(tmp_path: Path) -> None:
    law = contact.contact_law(study(tmp_path, law="press"), "one")
    assert isinstance(law, PressSpring)
    tangent = contact.contact_law(study(tmp_path, k_r="tangent"), "one")
    half = contact.contact_law(study(tmp_path, k_r="0.5 x secant"), "one")
    power = contact.contact_law(study(tmp_path, law="hertz", hertz_constant="press"), "one")
    assert isinstance(tangent, LinearSpring) and isinstance(half, LinearSpring)
    assert isinstance(power, HertzSpring)
    load = study(tmp_path).vehicle.static_load
    approach = power.approach_at(load)
    # tangent of Hertz's law at the static load
    assert 1.5 * power.stiffness * approach**0.5 == pytest.approx(tangent.stiffness, rel=1e-12)
    assert 2 * half.stiffness == pytest.approx(load / law.approach_at(load), rel=0.01)
    one = study(tmp_path, law="press", contact_filter="patch", patch_filter="following")
    assert isinstance(contact.contact_law(one, "one"), FollowingPatch)
    assert one.config()["runs"]["one"]["patch_weight"] == "press"
    assert [b.name for b in contact.bodies(one, "one")] == ["rail", "wheel", "press"]


def test_compliance_of_the_bay(tmp_path: Path) -> None:
    keys = {"rail": "timoshenko", "k_r": "tangent"}
    one = study(tmp_path, **keys, switches="local_compliance bay_compliance")
    assert [b.name for b in contact.bodies(one, "one")] == ["rail", "wheel", "bay", "press"]
    table = one.runs["one"]
    assert isinstance(table, PointRun)
    track = build.track(one)
    rail = build.point_track(one, table, track)
    # nothing in mid-bay, where the press is made, and the same in all bays
    middle = np.array([track.middle, track.middle - track.bay_length])
    np.testing.assert_allclose(rail.top_load_compliance(middle), 0.0, atol=1e-15)
    at_sleeper = float(rail.top_load_compliance(np.array([track.middle + 0.3]))[0])
    assert 1e-11 < at_sleeper < 1e-10


def test_a_run_beyond_its_press_says_so(tmp_path: Path) -> None:
    one = study(tmp_path, law="press")
    rough = load_study(tmp_path / "study.toml", ["irregularity.roughness=1"])
    with pytest.warns(UserWarning, match="more than the press was computed for"):
        data = execute_run(rough, "one")
    assert data.attrs["law"] == "press" and float(data.contact_force.min()) == 0.0
    assert one.presses("one")


def test_filters_act_in_runs(tmp_path: Path) -> None:
    plain = execute_run(study(tmp_path, law="hertz"), "one").contact_force
    spread = {}
    for keys in (
        {"contact_filter": "trajectory"},
        {"contact_filter": "patch"},
        {"contact_filter": "patch", "patch_filter": "following"},
        {"contact_filter": "bedding"},
    ):
        found = execute_run(study(tmp_path, law="hertz", **keys), "one")
        assert float(found.contact_force[0]) == pytest.approx(float(plain[0]), rel=2e-3)
        spread["-".join(keys.values())] = float(found.contact_force.std() / plain.std())
    print(spread)
    means = [spread[k] for k in ("patch", "patch-following", "bedding")]
    # all three average over the patch; a rigid wheel bridges little of waves of some um
    assert max(means) < 0.9 and max(means) - min(means) < 0.02
    assert spread["trajectory"] == pytest.approx(1.0, abs=0.02)


def test_a_batch_gives_each_run_as_alone(tmp_path):
    own = [{"k_r": f"{k} GN/m"} for k in (1, 2, 3, 5)] + [{"k_r": "1 GN/m", "rail": "timoshenko"}]
    studies = [study(tmp_path, **keys) for keys in own]
    told = []
    found = execute_batch(
        [(one, "one") for one in studies],
        lambda done, of: told.append((done, of)),
    )
    assert told[-1][0] == told[-1][1] == sum(run.attrs["steps"] for run in found)
    for run, one in zip(found, studies, strict=True):
        alone = execute_run(one, "one")
        for name in alone.data_vars:
            np.testing.assert_array_equal(run[name], alone[name])
