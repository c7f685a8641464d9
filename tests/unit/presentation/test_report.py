"""The report: pages, texts, special characters, equal bytes, wording that follows the values."""

import io
import json
import math
import re
from pathlib import Path

import pytest
from rich.console import Console

from contactstudy.plot.style import figure_style, new_figure, save
from contactstudy.report import write_report
from contactstudy.report.content import content
from contactstudy.report.parameters import parameter_tables
from contactstudy.report.quantity import fixed, percent, quantity
from contactstudy.resources import resource
from contactstudy.study.kind import KINDS, find_kind
from contactstudy.study.kinds.passage.drawings import drawings
from contactstudy.study.kinds.passage.metrics import study_metrics
from contactstudy.study.kinds.passage.report import reference_error
from contactstudy.study.kinds.passage.report.abstract import GRADES, abstract, grade
from contactstudy.study.kinds.passage.report.naming import papers_scheme
from contactstudy.study.kinds.passage.report.tables import run_table
from contactstudy.study.terminal import doubts, print_results, results_json

COST = {"seconds": {"setup": 1.25, "stepping": 0.375}, "peak_memory_mb": 187.5}
A4 = (595.276, 841.89)  # points


@pytest.fixture(scope="module")
def made(shared_results, tmp_path_factory):
    """Report of a small study with a companion: its data and its path."""
    study = shared_results
    out = tmp_path_factory.mktemp("report")
    place_figures(study, out)
    return study, out, write_report(study, out)[0]


def place_figures(study, out):
    """One small figure under the name of each: drawing them all is tested elsewhere."""
    with figure_style():
        axes = (figure := new_figure(1.0)).add_subplot()
        axes.plot([0, 1], [0, 1])
        files = [path.read_bytes() for path in save(figure, out, "small")]
    for each, folder in [(study, out), *((c, out / c.name) for c in study.companions)]:
        (folder / "figures").mkdir(parents=True)
        for made_figure in drawings(each):
            for data, kind in zip(files, ("pdf", "png"), strict=True):
                (folder / "figures" / f"{made_figure.name}.{kind}").write_bytes(data)


def pages(pdf):
    return re.findall(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", pdf)


def test_report_is_a_pdf_of_a4_pages(made):
    _, out, path = made
    pdf = path.read_bytes()
    assert path == out / "report.pdf"
    assert pdf.startswith(b"%PDF-")
    boxes = [tuple(map(float, box)) for box in pages(pdf)]
    assert len(boxes) >= 8
    assert all(box == pytest.approx(A4, abs=0.01) for box in boxes)
    assert list(out.glob(".*")) == []


def test_same_results_give_the_same_bytes(made, tmp_path):
    study, out, path = made
    before = [path.read_bytes(), path.with_suffix(".html").read_bytes()]
    assert [file.read_bytes() for file in write_report(study, out)] == before


def test_machine_times_are_left_out_unless_asked_for(made):
    study, *_ = made
    columns = [c["title"] for c in run_table(study, False)["columns"]]
    assert "Time step (µs)" in columns
    assert "Setup (s)" not in columns
    table = run_table(study, True)
    assert [c["title"] for c in table["columns"]][-3:] == [
        "Setup (s)",
        "Stepping (s)",
        "Memory (MB)",
    ]
    assert table["rows"][0][-3:] == ["1.25", "0.375", "188"]


def test_content_has_every_part(made):
    study, *_ = made
    data = content(study, False)
    titles = [part["title"] for part in data["results"]]
    assert titles == [
        "Irregularity",
        "Contact force",
        "Motion of the wheel",
        "Motion of the rail",
        "Contact patch",
        "Errors",
    ]
    captions = [b["caption"] for p in data["parameters"] for b in [p] if b["kind"] == "table"]
    assert captions == [
        "Irregularity.",
        "Track (per rail).",
        "Vehicle.",
        "Journey.",
        "Solid rail and wheel.",
    ]
    (companion,) = data["companions"]
    assert [p["title"] for p in companion["parts"]] == ["Runs", "Passing frequencies"]
    text = str(data)
    assert study.description in text
    assert "0123456789abcdef" in text


def test_description_is_set_in_paragraphs(made):
    study, *_ = made
    described = "\nLines of a\nparagraph with `a_run`.\n\nAnother one.\n"
    other = type(study)(**{**vars(study), "description": described})
    blocks = content(other, False)["subject"][:2]
    texts = ["".join(part["text"] for part in block["parts"]) for block in blocks]
    assert texts == ["Lines of a paragraph with `a_run`.", "Another one."]


def test_passing_table_puts_models_side_by_side(made):
    study, *_ = made
    blocks = content(study, False)["companions"][0]["parts"][-1]["blocks"]
    table = blocks[0]
    assert [row[0] for row in table["rows"]] == ["surface", "hertz timoshenko", "point", "tangent"]
    surface, _, point, _ = table["rows"]
    assert surface[3] == "350"  # N, as put into the signal
    assert surface[5:7] == ["–", "–"]  # the solid rail has cells, no elements
    assert point[5] == "48.0"
    assert point[7:9] == ["–", "–"]


def test_errors_stand_in_the_tables_as_in_the_metrics(made):
    study, *_ = made
    part = content(study, False)["results"][-1]
    tables = [b for b in part["blocks"] if b["kind"] == "table"]
    assert len(tables) == 5
    found = study.metrics["comparisons"]["point"]["contact_force"]
    row = next(r for r in tables[0]["rows"] if r[0] == "point")
    assert float(row[1]) == pytest.approx(100 * found["relative_l2"], rel=5e-3)
    assert float(row[2]) == pytest.approx(100 * found["relative_l2_dynamic"], rel=5e-3)
    assert float(row[3]) == pytest.approx(found["linf"] / 1e3, rel=5e-3)


def with_error(study, value):
    metrics = {**study.metrics, "comparisons": {}}
    for name, signals in study.metrics["comparisons"].items():
        force = {**signals["contact_force"], "relative_l2_dynamic": value}
        metrics["comparisons"][name] = {**signals, "contact_force": force}
    return type(study)(**{**vars(study), "metrics": metrics})


@pytest.mark.parametrize(("error", "k"), [(0.004, 0), (0.03, 1), (0.1, 2), (0.6, 3)])
def test_wording_of_the_abstract_follows_the_error(made, error, k):
    study, *_ = made
    text = " ".join(abstract(with_error(study, error)))
    assert GRADES[k][1] in text
    assert not any(words in text for _, words in GRADES[:k] + GRADES[k + 1 :])
    assert f"{percent(error)} % of the dynamic part" in text
    assert grade(error) == GRADES[k][1]


def test_abstract_tells_of_lost_contact(made):
    study, *_ = made
    assert "Contact is never lost." in abstract(study)[0]
    run = study.runs["point"]
    force = run["contact_force"].copy()
    force[2000:2010] = 0.0
    lost = {**study.runs, "point": run.assign(contact_force=force)}
    text = abstract(type(study)(**{**vars(study), "runs": lost}))[0]
    assert "Contact is lost at times in point." in text


@pytest.mark.parametrize("runs", [["point"], ["tangent"], ["tangent", "hertz_timoshenko"]])
def test_abstract_tells_of_each_run_once(made, runs):
    study, *_ = made
    compared = {name: study.metrics["comparisons"][name] for name in runs}
    metrics = {**study.metrics, "comparisons": compared}
    kept = {name: study.runs[name] for name in ("surface", *runs)}
    text = " ".join(abstract(type(study)(**{**vars(study), "metrics": metrics, "runs": kept})))
    assert text.count("kN apart") == len(runs)
    assert ("lowest" in text) == ("highest" in text) == (len(runs) > 1)


def test_abstract_tells_what_rolls_and_what_is_not_compared(made):
    study, _, _ = made
    assert "models of a wheel rolling on a rail run over one track" in abstract(study)[0]
    config = study.config | {"vehicle": {"type": "train"}}
    config["track"] = study.config["track"] | {"structure": "bridge"}
    runs = dict(study.runs)
    back = runs["point"].assign_coords(position=36.0 - runs["point"]["position"])
    runs["point"] = back.assign_attrs(travel="backward", start=6.0)
    told = abstract(type(study)(**{**vars(study), "config": config, "runs": runs}))[0]
    assert "models of a train rolling on rails run over one bridge" in told
    assert "“point” travels the other way and is not compared." in told


def test_abstract_of_a_study_without_runs_claims_nothing(made):
    study, *_ = made
    empty = {**vars(study), "runs": {}, "reference": None, "companions": (), "metrics": {}}
    text = " ".join(abstract(type(study)(**empty)))
    assert "no runs" in text
    assert "error" not in text


def test_the_papers_scheme_is_the_linear_euler_run(made):
    study, *_ = made
    assert papers_scheme(study) == "point"


def test_report_without_optional_parts(bare, tmp_path):
    place_figures(bare, tmp_path)
    path, _ = write_report(bare, tmp_path)
    data = content(bare, False)
    assert [p["title"] for p in data["results"]][:1] == ["Contact force"]
    assert data["companions"] == []
    assert len(pages(path.read_bytes())) >= 5


def test_template_has_no_figures_of_its_own():
    """Numbers of results come from data.json: no digits with units in the results' template."""
    for name in ("template.typ", "blocks.typ"):
        text = resource("report", name).read_text("utf-8")
        assert not re.search(r"\d\s*(kN|MPa|%\s*of|km/h|dB)", text), name


def test_every_table_of_a_study_has_a_title_in_the_report():
    for kind in map(find_kind, KINDS):
        assert set(kind.titles) == set(kind.tables)


def test_parameters_say_whether_the_study_set_them(made):
    study, *_ = made
    config = {**study.config, "journey": {**study.config["journey"], "speed": 83.33333333333334}}
    config["track"] = {**config["track"], "pad_stiffness": 60e6}
    other = type(study)(**{**vars(study), "config": config})
    rows = [row for block in parameter_tables(other) for row in block["rows"]]
    given = {row[0]: (row[1], row[3]) for row in rows}
    assert given["speed"] == ("300", "default")  # 300 km/h up to rounding
    assert given["pad stiffness"] == ("60", "study")
    assert given["wavenumber band"] == ("0.08, 20", "default")


@pytest.mark.parametrize(
    ("value", "unit", "wanted"),
    [
        (65e6, "N/m", ("65", "MN/m")),
        (75e3, "N*s/m", ("75", "kN·s/m")),
        (210e9, "Pa", ("210", "GPa")),
        (5e-5, "s", ("50", "µs")),
        (0.002, "m", ("2", "mm")),
        (0.6, "m", ("0.6", "m")),
        (1e16, "Pa/m", ("1·10¹⁶", "Pa/m")),
        (300 / 3.6, "m/s", ("300", "km/h")),
        ([50 / 3.6, 100 / 3.6], "m/s", ("50, 100", "km/h")),
        (8e-8, "m^2*rad/m", ("8·10⁻⁸", "m²·rad/m")),
        (1000, "", ("1000", "")),
        (0, "N/m", ("0", "N/m")),
        (True, "", ("yes", "")),
        (None, "m", ("none", "")),
        ("wheel_column", "", ("wheel_column", "")),
        ([0.0, 0.01], "m", ("0, 10", "mm")),
        ([18.0, 18.3], "m", ("18, 18.3", "m")),
        ([0.0, 0.024], "rad", ("0, 24", "mrad")),
        ([0.08, 20.0], "rad/m", ("0.08, 20", "rad/m")),
    ],
)
def test_quantities_get_prefixes(value, unit, wanted):
    assert quantity(value, unit) == wanted


def test_fixed_decimals():
    assert [fixed(v, 3) for v in (-1e-7, -0.0123, None, float("nan"))] == [
        "0.000",
        "−0.012",
        "–",
        "–",
    ]


def changed(study, **tables):
    """The study with other values in tables of its configuration."""
    config = dict(study.config)
    for key, values in tables.items():
        config[key] = {**config[key], **values}
    return type(study)(**{**vars(study), "config": config})


@pytest.mark.parametrize(
    "values",
    [
        {"k_r": 1e10},
        {"k_r": "tangent"},
        {"local_compliance": True},
        {"rail": "timoshenko"},
        {"law": "hertz"},
        {"contact_filter": "patch"},
        {"bay_compliance": True},
        {"integrator": "generalised_alpha"},
        {"irregularity": "smooth"},
        {"direction": "Y"},
        {"wheel": "modal"},
    ],
)
def test_no_other_run_is_called_our_reading_of_the_paper(made, values):
    study, *_ = made
    other = changed(study, runs={"point": {**study.config["runs"]["point"], **values}})
    assert papers_scheme(other) is None
    assert "paper's scheme" not in " ".join(abstract(other))


@pytest.mark.parametrize("values", [{"elements_per_bay": 8}, {"time_step": 1e-5}])
def test_what_the_paper_leaves_open_is_our_reading_too(made, values):
    study, *_ = made
    other = changed(study, runs={"point": {**study.config["runs"]["point"], **values}})
    assert papers_scheme(other) == "point"
    assert "our reading of the paper's scheme" in " ".join(abstract(other))


def sentences(blocks):
    return " ".join(part["text"] for b in blocks if b["kind"] == "text" for part in b["parts"])


def with_errors(study, softer=None, **dynamic):
    """The study with these errors of the dynamic part, and of one with a softer spring."""
    metrics = {**study.metrics, "comparisons": {}}
    for name, value in dynamic.items():
        signals = study.metrics["comparisons"][name]
        force = {**signals["contact_force"], "relative_l2_dynamic": value}
        if softer and name in softer:
            force["softer"] = {"k_r": 0.97, "relative_l2_dynamic": softer[name]}
        metrics["comparisons"][name] = {**signals, "contact_force": force}
    return type(study)(**{**vars(study), "metrics": metrics})


def test_the_conclusion_ranks_what_the_reference_can_tell_apart(made):
    study, *_ = made
    own = reference_error.DEFAULTS.dynamic
    close = with_errors(study, point=0.05 + 0.9 * own, tangent=0.05, hertz_timoshenko=0.4)
    told, table = content(close, False)["conclusion"]
    assert [row[:2] for row in table["rows"]] == [
        ["1", "tangent"], ["1", "point"], ["3", "hertz timoshenko"],
    ]  # fmt: skip
    assert all(row[3] == percent(own) for row in table["rows"])
    assert "point is as good within what can be told" in sentences([told])
    apart = with_errors(study, point=0.05 + 1.1 * own, tangent=0.05, hertz_timoshenko=0.4)
    assert [row[0] for row in content(apart, False)["conclusion"][1]["rows"]] == ["1", "2", "3"]


def test_the_conclusion_says_what_k_r_does(made):
    study, *_ = made
    some = with_errors(study, {"tangent": 0.0191}, tangent=0.0207, point=0.3)
    told = sentences(content(some, False)["conclusion"])
    assert "3 % less k_r its error is 1.91 instead of 2.07 %" in told
    assert "smaller than that" in told  # than the reference's own error
    more = with_errors(study, {"tangent": 0.03}, tangent=0.0207, point=0.3)
    assert "smaller than that" not in sentences(content(more, False)["conclusion"])


def test_no_model_is_recommended_that_is_far_off(made):
    study, *_ = made
    told = sentences(content(with_errors(study, point=0.4, tangent=0.3), False)["conclusion"])
    assert "None of the point models here can stand in" in told and "Use the" not in told


@pytest.mark.parametrize(
    ("table", "values", "named"),
    [
        ("solid", {"mesh_size": 0.004}, "solid.mesh_size"),
        ("journey", {"time_step": 2e-4}, "journey.time_step"),
        ("irregularity", {"band": [0.08, 314.0]}, "irregularity"),
        ("irregularity", {"wheel_defect": "flat"}, "irregularity"),
        ("runs", {"surface": {"solver": "surface", "wheel": "modal"}}, "wheel"),
    ],
)
def test_an_unknown_error_of_the_reference_is_called_unknown(made, table, values, named):
    study, *_ = made
    journey = {"time_step": 5e-5, **(values if table == "journey" else {})}
    others = {} if table == "journey" else {table: values}
    told, errors = content(changed(study, journey=journey, **others), False)["conclusion"]
    assert "not known" in sentences([told]) and named in sentences([told])
    assert [c["title"] for c in errors["columns"]] == ["Place", "Point model", "Error (%)"]


def test_one_point_model_has_no_table_of_places(made):
    study, *_ = made
    runs = {name: study.config["runs"][name] for name in ("surface", "tangent")}
    config = study.config | {"runs": runs}
    (told,) = content(type(study)(**{**vars(study), "config": config}), False)["conclusion"]
    assert "“tangent”" in sentences([told])


def test_an_inclination_is_shown_as_a_slope(made):
    study, *_ = made
    config = study.config | {"wheelset": {"rail_inclination": math.atan(1 / 40)}}
    tables = parameter_tables(type(study)(**{**vars(study), "config": config}))
    (row,) = (r for t in tables for r in t["rows"] if r[0] == "rail inclination")
    assert row[1:3] == ["1:40", ""]


def test_against_a_point_model_nothing_is_concluded(bare):
    assert content(bare, False)["conclusion"] == []


def test_next_to_no_dynamic_part_is_said_and_not_graded(made):
    study, *_ = made
    quiet = {}
    for name, run in study.runs.items():
        force = run["contact_force"]
        quiet[name] = run.assign(contact_force=force[0] + 0.004 * (force - force[0]))
    metrics = study_metrics(quiet, dict.fromkeys(quiet, COST), "surface", 9.0)
    other = type(study)(**{**vars(study), "runs": quiet, "metrics": metrics})
    told = " ".join(abstract(other))
    assert "too small to compare" in told
    assert not any(words in told for _, words in GRADES)
    data = content(other, False)
    assert data["conclusion"] == []
    (errors,) = [part for part in data["results"] if part["title"] == "Errors"]
    assert {row[2] for block in errors["blocks"] if block["kind"] == "table"
            for row in block["rows"]} == {"–"}  # fmt: skip


def test_one_run_has_no_errors_and_nothing_to_compare(made):
    study, *_ = made
    runs = {"point": study.runs["point"]}
    metrics = study_metrics(runs, {"point": COST}, None, 9.0)
    alone = {"runs": runs, "reference": None, "metrics": metrics, "companions": ()}
    other = type(study)(**{**vars(study), **alone})
    data = content(other, False)
    assert "Errors" not in [part["title"] for part in data["results"]]
    assert data["subject-title"] == "What is computed"
    assert "nothing to compare" in " ".join(data["abstract"])
    runs = {"surface": study.runs["surface"]}
    told = " ".join(abstract(type(study)(**{**vars(study), **alone, "runs": runs})))
    assert "The area of the contact patch lies between" in told


@pytest.mark.parametrize(
    ("start", "end", "words"),
    [
        (2000, None, "the wheel flies off at X ="),
        (2000, 2400, "is without contact on"),
        (2000, 2010, "Contact is lost at times in point."),
    ],
)
def test_lost_contact_is_told_with_its_place(made, start, end, words):
    study, *_ = made
    run = study.runs["point"]
    force, wheel = run["contact_force"].copy(), run["wheel_displacement"].copy()
    force[start:end], wheel[start:end] = 0.0, wheel[start:end] + 0.02
    lost = run.assign(contact_force=force, wheel_displacement=wheel)
    other = type(study)(**{**vars(study), "runs": {**study.runs, "point": lost}})
    told = abstract(other)[0]
    assert words in told
    if end is None:
        assert f"X = {float(run['position'][start]):.2f} m" in told and "mm above it" in told
    # the terminal says so too, of a wheel that does not come back
    warned = [text for text in doubts(other) if text.startswith("In point the wheel flies off")]
    assert len(warned) == (end is None) and not doubts(study)
    assert json.loads(results_json(other, Path("out")))["warnings"] == doubts(other)
    console = Console(file=io.StringIO(), width=100)
    print_results(other, Path("out"), console)
    assert ("warning: In point the wheel" in console.file.getvalue()) == (end is None)


def test_a_pulling_spring_has_not_lost_contact(made):
    study, *_ = made
    run = study.runs["point"]
    force = run["contact_force"].copy()
    force[2000:2010] = -5e3
    other = {**study.runs, "point": run.assign(contact_force=force)}
    told = abstract(type(study)(**{**vars(study), "runs": other}))[0]
    assert "pulls where the wheel would lift off, with up to 5.00 kN" in told
    assert "Contact is lost" not in told
