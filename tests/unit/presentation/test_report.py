"""The report: pages, texts, special characters, equal bytes, wording that follows the values."""

import re
from pathlib import Path

import pytest

from contactstudy.plot.style import figure_style, new_figure, save
from contactstudy.report import write_report
from contactstudy.report.content import content
from contactstudy.report.parameters import parameter_tables
from contactstudy.report.quantity import fixed, percent, quantity
from contactstudy.resources import resource
from contactstudy.study.kind import KINDS, find_kind
from contactstudy.study.kinds.passage.drawings import drawings
from contactstudy.study.kinds.passage.report.abstract import GRADES, abstract, grade, papers_scheme

A4 = (595.276, 841.89)  # points


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Report of a small study with a companion: its data and its path."""
    import importlib.util

    here = Path(__file__).with_name("conftest.py")
    spec = importlib.util.spec_from_file_location("presentation_results", here)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    study = module.made_study(companions=[module.made_study(rough=0.0, name="smooth_rail")])
    out = tmp_path_factory.mktemp("report")
    place_figures(study, out)
    return study, out, write_report(study, out)


def place_figures(study, out):
    """One small figure under the name of each: drawing them all is tested elsewhere."""
    with figure_style():
        axes = (figure := new_figure(1.0)).add_subplot()
        axes.plot([0, 1], [0, 1])
        pdf = save(figure, out, "small")[0].read_bytes()
    for each, folder in [(study, out), *((c, out / c.name) for c in study.companions)]:
        (folder / "figures").mkdir(parents=True)
        for made_figure in drawings(each):
            (folder / "figures" / f"{made_figure.name}.pdf").write_bytes(pdf)


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
    again = write_report(study, out)
    assert again.read_bytes() == path.read_bytes()


def test_machine_times_are_left_out_unless_asked_for(made):
    study, *_ = made
    columns = [c["title"] for c in content(study, False)["subject"][-1]["columns"]]
    assert "Time step (µs)" in columns
    assert "Setup (s)" not in columns
    table = content(study, True)["subject"][-1]
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
    assert texts == ["Lines of a paragraph with “a_run”.", "Another one."]


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
    path = write_report(bare, tmp_path)
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
    assert given["speed"] == ("83.3333", "default")  # 300 km/h up to rounding
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
        (8e-8, "m^2*rad/m", ("8·10⁻⁸", "m²·rad/m")),
        (1000, "", ("1000", "")),
        (0, "N/m", ("0", "N/m")),
        (True, "", ("yes", "")),
        (None, "m", ("none", "")),
        ("wheel_column", "", ("wheel_column", "")),
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
