"""Defects in a study: what is refused, files, and the shipped studies on their quick values."""

import numpy as np
import pytest

from contactstudy.driver import run_study
from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.inputs import read_inputs
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.roughness import describe, irregularity_of
from contactstudy.study.loading import load_study

SURFACE = {"surface": {"solver": "surface"}}


def problems_of(irregularity: dict, **tables: object) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        parse_study("bad", {"irregularity": irregularity, "runs": SURFACE, **tables})
    return caught.value.problems


@pytest.mark.parametrize(
    ("irregularity", "said"),
    [
        ({"wheel_defect": "flat", "wheel_defect_at": "9.01 m"}, "wheel_defect_at = 9.01: must be"),
        ({"rail_defect": "step", "rail_defect_at": "31 m"}, "rail_defect_at = 31.0: must be 9 to"),
        ({"rail_defect": "weld", "rail_defect_depth": "1 mm"}, "applies only with rail_defect"),
        ({"wheel_defect": "flat", "wheel_defect_orders": [3]}, "only with wheel_defect"),
        ({"wheel_defect": "depth_map"}, "wheel_defect_file: is missing"),
        ({"wheel_defect": "depth_map", "wheel_defect_file": "no.csv"}, "there is no such file"),
        (
            {"rail_defect": "corrugation", "rail_defect_length": "5 cm"},
            "must be at least two wavelengths",
        ),
        (
            {"wheel_defect": "out_of_round", "wheel_defect_orders": [1, 2]},
            "must be 2 numbers, one an order",
        ),
    ],
)
def test_what_is_impossible_is_refused_by_name(irregularity, said):
    (problem,) = problems_of(irregularity)
    assert problem.startswith("irregularity.") and said in problem


def test_a_map_for_a_half_section_must_be_the_same_at_both_sides(tmp_path):
    file = tmp_path / "map.csv"
    file.write_text("s,y,depth\n-5,-5,0\n-5,5,0\n5,-5,0\n5,5,0.1\n")
    table = {"wheel_defect": "depth_map", "wheel_defect_file": str(file)}
    (problem,) = problems_of(table)
    assert "not the same at y and -y" in problem
    study = parse_study("whole", {"irregularity": table, "solid": {"section": "whole"}})
    inputs = read_inputs(study)
    assert inputs.files.keys() == {"map.csv"}
    assert inputs.config["irregularity"]["wheel_defect_file"] == "map.csv"


def test_defects_come_on_top_of_the_spectrum_and_are_shown():
    table = {"rail_defect": "weld", "wheel_defect": "rounded_flat", "wheel_defect_at": "20 m"}
    study = parse_study("both", {"irregularity": table})
    plain, x = parse_study("plain", {}), np.array([12.0, 16.0, 20.0])
    added = irregularity_of(study)(x) - irregularity_of(plain)(x)
    np.testing.assert_allclose(added, [0.3e-3, 0.0, -(0.04**2) / (8 * 0.43)], atol=1e-15)
    info = describe(study).info
    assert info.profile.label == "paper, seed 1, with weld and rounded flat"
    np.testing.assert_array_equal(info.estimate.density, describe(plain).info.estimate.density)
    lateral = irregularity_of(study, direction="Y")(x)
    np.testing.assert_array_equal(lateral, irregularity_of(plain, direction="Y")(x))
    assert not irregularity_of(study, smooth=True)(x).any()


def test_the_shipped_studies_find_what_the_literature_says(tmp_path):
    """A. Pieringer, W. Kropp, J. C. O. Nielsen, Wear 314 (2014) 262: a Hertz spring that is fed
    the trajectory overestimates a flat's peak slightly, and fed the profile it can be badly wrong.
    """
    results = run_study(load_study("defects", quick=True), tmp_path, workers=1, quick=True)
    force = results.groups["sweep"]["largest"].sel(signal="contact_force").squeeze()
    peak = {name: force.sel(run=name).values for name in force["run"].values.tolist()}
    print(force.to_pandas() / 1e3)
    assert np.all(np.abs(peak["trajectory"] / peak["modal_surface"] - 1) < 0.2)
    assert np.all(peak["raw_profile"] > 1.3 * peak["modal_surface"])
    assert np.all(peak["point"] > 3 * peak["modal_surface"])
    assert (tmp_path / "dipped_joint" / "sweep.csv").read_text().count("largest.P1") == 1
