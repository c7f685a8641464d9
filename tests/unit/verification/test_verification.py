"""Checks, registry, kept cases, the command and its documents."""

import json
import math
import shutil
import subprocess

import pytest

from contactstudy import cli
from contactstudy.compare.refinement import fitted_order
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.plot.curves import Curve, Plot, curve
from contactstudy.report.verification import write_verification
from contactstudy.verification import cases, runner
from contactstudy.verification.case import Case, select
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_lines
from contactstudy.verification.outcome import from_data, judged, to_data


def check(computed=1.004, reference=1.0, band=0.01, **more):
    return Check("length", computed, reference, "m", "closed form", band, **more)


def result(name="good", *checks):
    return CaseResult(
        name,
        f"The case {name}",
        "What is done.\n\nAnd why.",
        checks or (check(), check(band=None)),
        (ResultTable("Numbers.", ("kind", "value (m)"), (("a", 1.5), ("b", None), ("c", 3))),),
        (Plot("Two curves.", "x (m)", "y (m)", (curve("a", [1, 2], [1, math.nan], "both"),)),),
    )


class FakeCase(Case):
    """A case without a module; counts its calls."""

    def load(self):
        def call():
            CALLS.append(self.name)
            if self.function == "breaks":
                raise NumericalError("the active set does not settle")
            if self.function == "stops":
                raise KeyboardInterrupt
            return result(self.name, check(1.1)) if self.function == "fails" else result(self.name)

        return call


CALLS: list[str] = []


@pytest.fixture
def registered(monkeypatch):
    """Replace the registered cases by fake ones."""

    def register(*made):
        monkeypatch.setattr(cases, "CASES", tuple(made))
        CALLS.clear()

    return register


@pytest.mark.parametrize(
    ("made", "error", "passed"),
    [
        (check(), 0.004, True),
        (check(1.02), 0.02, False),
        (check(0.98), -0.02, False),
        (check(1.02, band=None), 0.02, None),
        (check(2.0, band=0.0, sense="at_least"), 1.0, True),
        (check(0.9, band=0.0, sense="at_least"), -0.1, False),
        (check(0.9, band=0.0, sense="at_most"), -0.1, True),
        (check(1.2, band=0.1, sense="at_most"), 0.2, False),
        (check(0.1, 0.0, 0.01, scale=20.0), 0.005, True),
        (check(0.1, 0.0, 0.01), math.nan, False),
        (check(0.0, 0.0, 0.0), math.nan, True),
        (check(math.nan), math.nan, False),
    ],
)
def test_error_and_verdict(made, error, passed):
    assert made.error == pytest.approx(error, nan_ok=True)
    assert made.passed is passed


def test_description_has_reference_beside_computed():
    text = check_lines([check(), check(2.0, sense="at_least", band=0.0), check(1.1)])
    assert "1.004 m (reference 1, closed form): +0.4 %, band 1 %: ok" in text
    assert "reference at least 1" in text and text.endswith("FAILS")


def test_rows_and_curves_must_fit():
    with pytest.raises(ValueError, match=r"rows \[1\]"):
        ResultTable("T", ("a", "b"), ((1, 2), (1,)))
    with pytest.raises(ValueError, match="2 abscissae, 1 ordinates"):
        Curve("c", (1.0, 2.0), (1.0,))


def test_fitted_order_of_a_power():
    sizes = [1.0, 0.5, 0.25, 0.125]
    assert fitted_order(sizes, [3 * h**1.7 for h in sizes]) == pytest.approx(1.7)


def test_results_survive_the_file():
    made = result("good", check(), check(math.nan), check(0.1, 0.0, scale=2.0))
    data = json.loads(json.dumps(to_data(made), allow_nan=False))
    assert data["checks"][0]["passed"] is True and data["checks"][1]["computed"] is None
    back = from_data(data)
    assert back.tables == made.tables and back.checks[2] == made.checks[2]
    assert math.isnan(back.checks[1].computed) and math.isnan(back.figures[0].curves[0].y[1])
    assert to_data(back) == data


def test_every_registered_case_can_be_called():
    names = [case.name for case in cases.CASES]
    assert len(set(names)) == len(names)
    for case in cases.CASES:
        assert callable(case.load())
        assert all(need.split(":")[0] in ("program", "package") for need in case.needs)


def test_unknown_cases_are_all_listed_with_those_that_are():
    with pytest.raises(InputError) as error:
        select(cases.CASES, ("hertz_line", "hertz_lin", "moon"))
    assert len(error.value.problems) == 2
    assert "'moon'" in str(error.value) and "ssnv104" in str(error.value)
    assert [case.name for case in select(cases.CASES, ("ssnv104", "hertz_line"))] == [
        "hertz_line",
        "ssnv104",
    ]


def test_a_package_without_its_compiled_part_is_missing(tmp_path, monkeypatch):
    (tmp_path / "half_installed.py").write_text("from half_installed_core import solve")
    monkeypatch.syspath_prepend(tmp_path)
    case = Case("far", "far:far", needs=("package:half_installed",))
    assert case.missing() == ("the package half_installed",)


def test_what_is_missing_is_named():
    case = Case("far", "far:far", needs=("program:no_such_program", "package:json"))
    assert case.missing() == ("the program no_such_program",)
    assert case.about == "needs the program no_such_program and the package json"


def test_verify_writes_everything_and_keeps_what_is_finished(registered, tmp_path, capsys):
    registered(FakeCase("good", ""), FakeCase("long", "", slow=True))
    assert cli.main(["verify", "--quick", "--workers", "1", "--out", str(tmp_path)]) == 0
    out = capsys.readouterr()
    assert out.out.strip().endswith("verification.pdf")
    assert "good: 1 of 1 checks within their bands, 1 reported without a band" in out.err
    assert "long: not run: takes long" in out.err
    data = json.loads((tmp_path / "verification.json").read_text())
    assert [c["status"] for c in data["cases"]] == ["passed", "not run"]
    assert data["cases"][0]["checks"][0]["error"] == pytest.approx(0.004)
    assert data["versions"]["contactstudy"] and len(data["code"]) == 16
    first = (tmp_path / "verification.pdf").read_bytes()
    assert (tmp_path / "figures" / "good_1.pdf").is_file()
    assert cli.main(["verify", "--quick", "--workers", "1", "--out", str(tmp_path)]) == 0
    assert CALLS == ["good"]  # the second time it was there
    assert (tmp_path / "verification.pdf").read_bytes() == first


def test_a_damaged_case_is_computed_again(registered, tmp_path):
    registered(FakeCase("good", ""))
    runner.run_cases(select(cases.CASES), tmp_path)
    (kept,) = (tmp_path / "cases").glob("*.json")
    kept.write_text(kept.read_text().replace("1.004", "1.005"))
    (outcome,) = runner.run_cases(select(cases.CASES), tmp_path)
    assert CALLS == ["good", "good"] and outcome.result.checks[0].computed == 1.004


def test_a_check_that_fails_or_a_case_that_breaks_down_ends_with_1(registered, tmp_path, capsys):
    registered(FakeCase("bad", "fails"), FakeCase("worse", "breaks"), FakeCase("good", ""))
    assert cli.main(["verify", "--workers", "1", "--out", str(tmp_path)]) == 1
    err = capsys.readouterr().err
    assert "bad: length: 1.1 m against 1 (closed form), +10 %; band 1 %" in err
    assert "worse: broke down: NumericalError: the active set does not settle" in err
    assert CALLS == ["bad", "worse", "good"] and (tmp_path / "verification.pdf").is_file()


def test_an_interrupt_keeps_what_is_finished(registered, tmp_path):
    registered(FakeCase("good", ""), FakeCase("stopped", "stops"))
    assert cli.main(["verify", "--workers", "1", "--out", str(tmp_path)]) == 130
    assert [path.name[:4] for path in (tmp_path / "cases").iterdir()] == ["good"]


def test_cases_in_processes_of_their_own(tmp_path):
    chosen = (*select(cases.CASES, ("hertz_line",)), Case("gone", "nowhere:gone"))
    apart = runner.run_cases(chosen, tmp_path, workers=2)
    assert [o.status for o in apart] == ["passed", "broke down"]
    assert "ModuleNotFoundError" in apart[1].reason
    here = chosen[0].load()()
    for mine, theirs in zip(here.checks, apart[0].result.checks, strict=True):
        assert mine.computed == pytest.approx(theirs.computed, rel=1e-9)
    assert len(list((tmp_path / "cases").iterdir())) == 1


def test_unknown_case_ends_with_2(capsys, tmp_path):
    assert cli.main(["verify", "moon", "--out", str(tmp_path / "x")]) == 2
    assert "case 'moon': unknown; the cases are hertz_line" in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


def test_list_runs_nothing(capsys):
    assert cli.main(["verify", "--list"]) == 0
    out = capsys.readouterr().out
    assert "hertz_line" in out and "slow" in out


def test_document_has_method_numbers_and_verdict(tmp_path):
    reader = shutil.which("pdftotext")
    if reader is None:
        pytest.skip("pdftotext is not installed")
    outcomes = [judged(result("good", check(), check(1.1), check(2.0, sense="at_least", band=0.0)))]
    pdf = write_verification(outcomes, runner.about(), tmp_path)
    text = subprocess.run([reader, "-layout", pdf, "-"], capture_output=True, text=True).stdout
    for expected in ("The case good (good)", "And why.", "1.0040", "closed form", "LEFT", "2 of 3"):
        assert expected in text
    assert "at least 1.0000" in text and "Two curves." in text
