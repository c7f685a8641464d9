"""What users write is shown, drawn, set and stored as it is, or refused; it is never markup."""

import io
import json
import re
import shutil
import subprocess
import unicodedata

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.console import Console
from rich.table import Table
from short_study import POINT as SHORT

from contactstudy import cli
from contactstudy.exceptions import InputError
from contactstudy.plot.fonts import foreign, lacking, remark
from contactstudy.plot.style import figure_style, new_figure
from contactstudy.report.blocks import bullets, table, text
from contactstudy.report.typesetting import typeset
from contactstudy.study import terminal
from contactstudy.study.loading import load_study
from contactstudy.study.results import StudyResults, read_results, write_results
from contactstudy.texts import json_text, problem_of_text, visible

NASTY = (
    "[b]bold[/b]", "[/]", "$x^2$", "$", r"\frac{1}{2} \\ \n", "#emph[x]", "#", "@ref", "_a_ *b*",
    "`c`", "<d>", "&amp;", ":smile:", "// no comment", "/* nor */", "= none", "~", "%s %d {0} {",
    "轨道", "سلام", "שלום", "\u202eturned", "e\u0301", "😀", "👩‍🔬", "k_r", "a\u00a0b", "--", '"q"',
    "\ufffe",
)  # fmt: skip
WORDS = st.lists(st.sampled_from(NASTY), min_size=1, max_size=5).map(" ".join)
ANY = st.text(st.characters(exclude_categories=("Cc", "Cs")), min_size=1, max_size=40)


@given(st.text())
def test_nothing_steers_a_terminal(given):
    shown = visible(given)
    assert {c for c in shown if unicodedata.category(c) in ("Cc", "Cs")} <= {"\n", "\t"}
    if not problem_of_text(given, lines=True):
        assert shown == given
    shown.encode()


@given(st.text(st.characters()), st.sampled_from(["\0", "\x1b", "\x7f", "\x9b", "\ud800", "\r"]))
def test_control_characters_are_refused(given, wrong):
    assert f"U+{ord(wrong):04X}" in problem_of_text(wrong + given)
    assert "U+202E" in problem_of_text("a\u202eb") and not problem_of_text("\u05d0b")
    assert problem_of_text("a\nb") and not problem_of_text("a\n\tb", lines=True)


@given(st.recursive(st.text(), lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner)))
def test_json_holds_every_text(given):
    text = json_text(given)
    assert json.loads(text.encode()) == given  # halves of pairs too, as names of files have


@given(WORDS | ANY)
def test_terminal(given):
    made = terminal.console()
    stream = io.StringIO()
    console = Console(file=stream, width=500, markup=made._markup, emoji=made._emoji)
    console.print(given, soft_wrap=True)
    reporter = terminal.TerminalReporter(console)
    reporter.note(given)
    shown = Table("a", box=None, show_header=False)
    shown.add_row(given)
    console.print(shown)
    lines = [line.strip() for line in stream.getvalue().split("\n")]
    assert lines[:2] == [given.strip()] * 2
    assert lines[2].split() == given.split() or len(given) != len(lines[2])  # rich joins emoji


def results(name: str) -> StudyResults:
    config = {"irregularity": {"file": name}, name: [name]}
    data = xr.Dataset({"x": ("n", np.arange(2.0))}, attrs={"text": name})
    return StudyResults(name, name, name, config, {}, {"run": data}, None, {name: name})


@settings(max_examples=20)
@given(WORDS | ANY)
def test_netcdf_and_json(tmp_path_factory, given):
    folder, made = tmp_path_factory.mktemp("results"), results(given)
    write_results(made, folder)
    found = read_results(folder)
    assert (found.name, found.title, found.description) == (given,) * 3
    assert found.config == made.config and found.metrics == made.metrics
    assert found.runs["run"].attrs["text"] == given


@settings(max_examples=10)
@given(st.lists(WORDS | ANY, min_size=20, max_size=20))
def test_figures(given):
    with figure_style(" ".join(given)):
        figure = new_figure(8.0)
        axes = figure.add_subplot()
        axes.set(title=given[0], xlabel=given[1])
        for k, words in enumerate(given[2:]):
            axes.plot([0, 1], [k, k], label=words)
        axes.legend()
        figure.canvas.draw()
        assert not any(t.get_parse_math() for t in axes.get_legend().get_texts())


def document(title: str, words: list[str]) -> dict:
    rows = [[word, word] for word in words]
    blocks = [text(title), bullets(words), table(["a_b", "$c$"], rows, title)]
    case = {"title": title, "blocks": blocks}
    return {
        "title": title, "subtitle": title, "name": title, "summary": blocks,
        "cases": [case] * 4, "provenance": blocks,
    }  # fmt: skip


@settings(max_examples=8)
@given(st.lists(WORDS | ANY, min_size=10, max_size=10))
def test_typesetting(tmp_path_factory, given):
    made = typeset(("sections.typ",), document(given[0], given), tmp_path_factory.getbasetemp())
    assert made.startswith(b"%PDF")


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="pdftotext is not installed")
def test_pdf_says_what_was_written(tmp_path):
    latin = [word for word in NASTY if word.isascii() and word != "k_r"]
    file = tmp_path / "a.pdf"
    file.write_bytes(typeset(("sections.typ",), document("a title", latin), tmp_path))
    found = subprocess.run(["pdftotext", "-raw", file, "-"], capture_output=True, check=True)
    lines = re.sub(r"\s+", " ", found.stdout.decode())
    assert [word for word in latin if word not in lines] == []


def test_fonts():
    assert foreign("ω₁ ≤ 3·10⁻⁴ “Übergröße” Ж") == "" and remark("a", "straße") == ""
    assert foreign("سلام") and lacking("سلام שלום 😀") == ""
    assert lacking("a轨b道轨") == "轨道"
    assert "lack 轨, 道; these are drawn with a font of this machine" in remark("a", "轨道")


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('title = "a\\u001b[31mred"', r'title = "a\x1b[31mred": must be one line of text'),
        ('title = "a\\nb"', "must be one line of text without control characters (has U+000A)"),
        ('description = "a\\u0000b"', "must be text without control characters (has U+0000)"),
        (f'[runs.{"p" * 300}]\nsolver = "point"', "at most 100 of them"),
        ('[runs."../a"]\nsolver = "point"', "a run's name is letters, digits and _"),
        ('[runs.Point]\nsolver = "point"', "differs from the run point only in capitals"),
        ('[runs.nul]\nsolver = "point"', "no file may have this name on Windows"),
    ],
)
def test_texts_and_names_that_are_refused(tmp_path, capfd, line, told):
    file = tmp_path / "study.toml"
    file.write_text(line + SHORT if line.startswith(("t", "d")) else SHORT + line)
    assert cli.main(["check", str(file)]) == 2
    err = capfd.readouterr().err
    assert told in err and "\x1b" not in err and "\0" not in err


@pytest.mark.parametrize("name", ["a\nb", "a\x1bb", "\udcff"])
def test_study_files_with_impossible_names(tmp_path, name):
    file = tmp_path / f"{name}.toml"
    file.write_text(SHORT)
    with pytest.raises(InputError, match="must be one line of text without control characters"):
        load_study(file)


def test_folders_may_be_called_anything(tmp_path, capfd):
    """A folder whose name is no UTF-8, in paths of the configuration, and of the results."""
    folder = tmp_path / "no\udcff utf-8 [b] $x$ %"
    folder.mkdir()
    level = "\n".join(f"{0.05 * k:.2f},{(k * 7919 % 101) / 1000}" for k in range(200))
    (folder / "level.csv").write_text("x,level\n" + level)
    table = (
        '[irregularity]\nspectrum = "measured"\nfile = "level.csv"\nlevel_column = "level"\n'
        'level_unit = "mm"\nwavelengths = ["0.2 m", "2 m"]'
    )
    (folder / "study.toml").write_text(SHORT.replace("[irregularity]\nterms = 50", table))
    for _ in range(2):
        command = ["run", str(folder / "study.toml"), "--out", str(folder / "out")]
        assert cli.main([*command, "--workers", "1"]) == 0, capfd.readouterr().err
        err = capfd.readouterr().err
    assert "up to date" in err and "no\\udcff utf-8" in err
    assert (folder / "out" / "report.pdf").is_file()
