"""The documentation: it builds without a warning, and its commands and links are real."""

import html
import html.parser
import json
import re
import shlex
import tomllib
from pathlib import Path
from typing import get_args, get_type_hints

import pytest
from built_site import docs_module
from matplotlib import pyplot

from contactstudy.commands import app
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.verification.cases import CASES

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", *sorted(DOCS.glob("*.md"))]


def commands():
    for page in PAGES:
        text = page.read_text("utf-8")
        for block in re.findall(r"```bash\n(.*?)```", text, re.DOTALL):
            for line in block.splitlines():
                if line.startswith("contactstudy "):
                    yield pytest.param(line, id=f"{page.stem}: {line[13:60]}")


@pytest.mark.parametrize("line", list(commands()))
def test_every_command_is_one(line):
    """Its options and arguments are known; nothing runs."""
    tokens = shlex.split(line, comments=True)[1:]
    command, bound, _ = app.parse_args(tokens, exit_on_error=False, print_error=False)
    assert callable(command) and bound is not None


def test_numbers_of_the_book_are_those_of_the_run(site):
    text = (site / "book" / f"{CASES[0].name}.html").read_text("utf-8")
    for part in ("Two times two.", "4.004 mm", "0.1 %", "0.2 %", "1024", "Powers | of two"):
        assert part in text
    assert "9.9" in (site / "book" / "index.html").read_text("utf-8")


def test_how_wrong_says_what_the_results_say(site):
    studies = json.loads((DOCS / "error_study.json").read_text("utf-8"))
    text = (site / "how_wrong.html").read_text("utf-8")
    plain = " ".join(html.unescape(re.sub(r"<[^>]*>", "", text)).split())
    assert len(studies) > 1
    for study in studies:
        for said in (study["title"], study["command"], study["code"], *study["told"]):
            assert letters(said) in letters(plain)
        for figure in study["figures"]:
            assert f"_images/{figure['file']}" in text
            assert (site / "_images" / figure["file"]).is_file()
        for block in study["conclusion"]:
            for row in block.get("rows", []):
                assert all(letters(cell) in letters(plain) for cell in row)
    assert sum(path.stat().st_size for path in (DOCS / "error_study").iterdir()) < 2e6


def letters(text):
    """Letters and digits alone: Sphinx sets its own quotation marks, dashes and spaces."""
    return "".join(c for c in text if c.isalnum())


PAGE = """
```toml
# mine.toml
title = "Mine"
```

```python
from pathlib import Path
print(Path("mine.toml").read_text().count("Mine"), 0.3448, "of", 7)
```

The error is 34 %.

```text
1 0.345 ... 7
```
"""


@pytest.fixture(scope="module")
def executed():
    return docs_module("executed")


def test_blocks_of_a_page_run_and_say_what_they_print(executed, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    executed.run_page("page.md", PAGE)


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("0.345", "0.347", "page.md:14: “1 0.347 ... 7” was not printed"),
        ("1 0.345", "2 0.345", "was not printed"),
        ("34 %", "37 %", "37 % is no number of the page's blocks"),
        ("of", "of, wrongly", "page.md:14"),
        ("from pathlib", "from pathlob", "page.md:7: ModuleNotFoundError"),
        ("```python", "```bash\ncontactstudy runs mine.toml\n```\n```python", "ends with 2"),
        ("# mine.toml\n", "", "page.md:2: its first line does not name a file"),
        ("```python", "```fortran", "no block of fortran"),
    ],
)
def test_a_page_that_says_something_else_is_refused(
    executed, tmp_path, monkeypatch, right, wrong, told
):
    monkeypatch.chdir(tmp_path)
    page = PAGE.replace(right, wrong) if right != "of" else PAGE.replace("...", wrong)
    with pytest.raises(executed.PageError, match=re.escape(told)):
        executed.run_page("page.md", page)


def test_a_page_leaves_no_figure_open(executed, tmp_path, monkeypatch):
    """The gallery, built after the pages, shows what is open in its first example."""
    monkeypatch.chdir(tmp_path)
    executed.run_page("page.md", "```python\nimport matplotlib.pyplot as plt\nplt.figure()\n```\n")
    assert pyplot.get_fignums() == []


TABLES = """
```toml
# mine.toml
title = "Mine"

[one]
a = 1

[two]
a = 2
b = 2

[three]
```

```toml
# in mine.toml
[two]
b = 3
```
"""


def test_tables_of_a_file_are_put_in_the_place_of_its_own(executed, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    executed.run_page("page.md", TABLES)
    found = tomllib.loads(Path("mine.toml").read_text("utf-8"))
    assert found == {"title": "Mine", "one": {"a": 1}, "two": {"b": 3}, "three": {}}
    with pytest.raises(executed.PageError, match=r"page\.md:16: mine\.toml has no table \[four\]"):
        executed.run_page("page.md", TABLES.replace("[two]\nb = 3", "[four]"))


def test_formulas_need_no_script(site):
    text = (site / "theory.html").read_text("utf-8")
    assert text.count("<math ") > 10
    assert not re.search(r"<script[^>]*(math|tex)", text, re.IGNORECASE)
    assert "def tangent_stiffness" in re.sub(r"<[^>]*>", "", text)


def test_every_key_and_command_is_listed(site):
    keys = (site / "reference" / "keys.html").read_text("utf-8")
    assert "pad_stiffness" in keys and "wheel_defect_length" in keys
    listed = (site / "reference" / "commands.html").read_text("utf-8")
    for name in (n for n in app if not n.startswith("-")):
        assert f"contactstudy {name}" in listed


class Links(html.parser.HTMLParser):
    """References of a page: to pages, pictures, scripts, styles."""

    def __init__(self):
        super().__init__()
        self.found, self.anchors = [], set()

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.anchors |= {given["id"]} if "id" in given else set()
        self.found += [given[k] for k in ("href", "src") if given.get(k)]


def test_no_link_is_dead_and_nothing_comes_from_the_network(site):
    pages = {}
    for path in site.rglob("*.html"):
        pages[path] = Links()
        pages[path].feed(path.read_text("utf-8"))
    assert len(pages) > 10
    for path, page in pages.items():
        for link in page.found:
            target, _, anchor = link.partition("#")
            target = target.partition("?")[0]
            if re.match(r"[a-z]+:", link):
                assert link.startswith(("https://", "data:", "mailto:")), link
                assert not re.search(r"\.(js|css|woff2?)$", link), link
                continue
            found = (path.parent / target).resolve() if target else path
            assert found.exists(), f"{path.name}: {link}"
            if anchor and found in pages:
                assert anchor in pages[found].anchors, f"{path.name}: {link}"


def test_the_book_of_the_checkout_is_a_real_run():
    data = json.loads((DOCS / "verification.json").read_text("utf-8"))
    assert {case["name"] for case in data["cases"]} <= {case.name for case in CASES}
    assert any("checks" in case for case in data["cases"])


def test_every_law_and_filter_has_its_theory():
    text = (DOCS / "theory.md").read_text("utf-8")
    types = get_type_hints(PointRun)
    for key, plain in {"law": "linear", "contact_filter": "none", "patch_filter": "fixed"}.items():
        values = get_args(types[key])
        assert plain in values
        for value in set(values) - {plain}:
            assert f'`{key} = "{value}"`' in text


def test_every_displayed_equation_is_followed_by_its_code():
    """Within its section, before the next heading."""
    sections = (DOCS / "theory.md").read_text("utf-8").split("\n## ")[1:]
    assert len(sections) > 5
    for section in sections:
        last = section.rfind("$$")
        assert "{literalinclude}" in section[last:], section.partition("\n")[0]
        assert section.count("{literalinclude}") >= 2
