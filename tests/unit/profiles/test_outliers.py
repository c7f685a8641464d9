"""Points off a measured profile: named and left out, or said with what they do to the curvature."""

import numpy as np
import pytest

from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.outliers import outliers, steps
from contactstudy.profiles.worn import worn_curve

DRAWN = {"rail": rail_curve("60E1"), "wheel": wheel_curve("S1002")}
ENDS = {"rail": (-0.0355, 0.0355), "wheel": (-0.0455, 0.055)}


def sampled(body, spacing, noise=0.0, seed=1):
    """Points as a file holds them, rounded to 0.1 um, and their normals."""
    s = np.arange(*ENDS[body], spacing)
    normal = DRAWN[body].normal(s)
    offset = noise * np.random.default_rng(seed).standard_normal((len(s), 1))
    return np.round(DRAWN[body].point(s) + offset * normal, 7), normal, s


@pytest.mark.parametrize("body", ["rail", "wheel"])
@pytest.mark.parametrize("noise", [0.0, 0.5e-6, 3e-6])
@pytest.mark.parametrize("spacing", [0.1e-3, 0.2e-3, 0.25e-3, 0.5e-3, 1e-3])
def test_a_sound_profile_has_none(body, noise, spacing):
    p, _, _ = sampled(body, spacing, noise)
    assert not len(outliers(p)[0]) and not len(steps(p)[0])


@pytest.mark.parametrize("body", ["rail", "wheel"])
@pytest.mark.parametrize("height", [5e-5, -2e-4])
@pytest.mark.parametrize("k", [0, 1, 2, 3, -4, -3, -2, -1])
def test_a_point_off_at_an_end_is_itself_left_out(body, height, k):
    p, normal, _ = sampled(body, 0.5e-3)
    p[k] += height * normal[k]
    which, off = outliers(p)
    assert which.tolist() == [k % len(p)] and off == pytest.approx([abs(height)], rel=0.05)


@pytest.mark.parametrize("seed", range(60))
def test_points_off_are_found_wherever_they_are(seed):
    """One to three neighbours of 5 to 200 um, on running surfaces, among scatter they exceed."""
    random = np.random.default_rng(seed)
    body, spacing = random.choice(["rail", "wheel"]), random.choice([0.2e-3, 0.3e-3, 0.5e-3, 1e-3])
    height = random.choice([5e-6, 1e-5, 2e-5, 5e-5, 2e-4]) * random.choice([-1, 1])
    p, normal, s = sampled(body, spacing, abs(height) / 25 * random.random(), seed)
    count = random.integers(1, 4)
    k = random.choice(np.flatnonzero(np.abs(s) < 0.019)) + np.arange(count)
    p[k] += height * normal[k]
    which, off = outliers(p)
    found = dict(zip(which.tolist(), off.tolist(), strict=True))
    assert set(k.tolist()) <= found.keys() <= set(range(k[0] - 1, k[-1] + 2))
    assert [found[i] for i in k.tolist()] == pytest.approx([abs(height)] * count, rel=0.35)


@pytest.mark.parametrize("seed", range(30))
def test_steps_are_found_with_what_they_do(seed):
    random = np.random.default_rng(seed)
    body, spacing = random.choice(["rail", "wheel"]), random.choice([0.2e-3, 0.3e-3, 0.5e-3])
    height = random.choice([5e-6, 2e-5, 1e-4])
    p, normal, s = sampled(body, spacing, height / 50 * random.random(), seed)
    k = random.choice(np.flatnonzero(np.abs(s) < 0.019))
    p[k:] += height * normal[k]
    at, found, bend = steps(p)
    assert k in at and np.abs(at - k).max() <= 1
    assert found[list(at).index(k)] == pytest.approx(height, rel=0.3) and np.all(bend > 1.0)
    # points beside it may count as off, and be left out
    assert all(abs(i - k) <= 4 for i in outliers(p)[0])


@pytest.mark.parametrize("body", ["rail", "wheel"])
@pytest.mark.parametrize("height", [5e-6, 2e-5, 5e-5])
def test_what_is_done_to_the_curvature_is_small_or_said(tmp_path, body, height):
    """At 0.5 mm between points: a spike is left out, a step is said to within a factor of two."""
    clean, normal, s = sampled(body, 0.5e-3)
    k = int(np.argmin(np.abs(s - 0.003)))
    at = np.linspace(-0.005, 0.008, 300)

    def curvature(points):
        file = tmp_path / "worn.csv"
        rows = [f"{1e3 * y:.4f},{1e3 * z:.4f}" for y, z in points]
        file.write_text("\n".join(["y [mm],z [mm]", *rows]))
        curve = worn_curve(file, body)
        return curve.curvature(at), curve.notes

    spike, step = clean.copy(), clean.copy()
    spike[k] += height * normal[k]
    step[k:] += height * normal[k]
    sound, none = curvature(clean)
    without, named = curvature(spike)
    bent, said = curvature(step)
    assert none == ()
    (named,) = named
    assert f"line {k + 2}:" in named and "left out" in named
    assert np.abs(without - sound).max() < 0.3
    told = [note for note in said if "from here on" in note]
    assert len(told) == 1 and abs(int(told[0].split("line ")[1].split(":")[0]) - (k + 2)) <= 2
    told = float(told[0].split("about ")[1].split()[0])
    assert 0.5 < told / np.abs(bent - sound).max() < 2.0
