"""Unloading and Y/Q of wheels."""

import numpy as np

from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.reading import parse_study


def run(track=None, spectrum="german_low", model="three_dimensional", **journey):
    made = parse_study(
        "wheels",
        {
            "track": {"structure": "bridge", "spans": [6.0], "approach_before": 12.0,
                      "approach_behind": 12.0, **(track or {})},
            "vehicle": {"type": "train", "cars": ["high_speed_trailer"], "model": model},
            "journey": {"speed": 60.0, "time_step": 1e-3, "to": 26.0, **journey},
            "irregularity": {"spectrum": spectrum},
            "runs": {"one": {"solver": "point", "k_r": 1e9}},
        },
    )  # fmt: skip
    return execute_run(made, "one")


def test_a_mirrored_track_mirrors_the_quotients():
    """What the right wheel does on one track the left one does on its mirror image."""
    data, other = (run({"track_offset": y}, "smooth") for y in (2.5, -2.5))
    left = data.lateral_force.values[1::2]
    assert np.abs(left).max() > 1.0
    np.testing.assert_allclose(left, -other.lateral_force.values[::2], atol=1e-3)
    quotient, mirrored = data.derailment_quotient.values, other.derailment_quotient.values
    np.testing.assert_allclose(quotient[1::2], mirrored[::2], atol=1e-7)
    # outwards is to the left of +X on the left rail
    np.testing.assert_allclose(
        quotient[1::2] * data.contact_force.values[1::2], left, rtol=1e-9, atol=1e-9
    )


def test_unloading_is_what_the_static_load_lacks():
    data = run(model="planar")
    load = np.array(data.attrs["static_load"])[:, None]
    np.testing.assert_allclose(load * (1.0 - data.wheel_unloading), data.contact_force, rtol=1e-12)
    # the car's weight stays: over a passage the mean unloading is next to nothing
    assert abs(float(data.wheel_unloading.mean())) < 0.02 < float(data.wheel_unloading.max())
    assert "derailment_quotient" not in data
