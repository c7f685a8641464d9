"""The site as tests read it: built once, with a book of one case whose numbers are known."""

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

from contactstudy.verification.cases import CASES
from contactstudy.verification.check import CaseResult, Check, ResultTable
from contactstudy.verification.outcome import judged, write_json

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
GENERATED = ("book", "reference", "generated", "examples", "made", "how_wrong.md")


def docs_module(name: str) -> ModuleType:
    """A module of the site's own, `docs/name.py`."""
    spec = importlib.util.spec_from_file_location(name, DOCS / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def build(work: Path, whole: bool = False) -> Path:
    """Build the site in `work`, with the whole book if so asked; its folder.

    In a process of its own, as a user does: pages start schedulers and change folders.
    """
    shutil.copytree(DOCS, work / "docs", ignore=shutil.ignore_patterns(*GENERATED))
    (work / "contactstudy").symlink_to(ROOT / "contactstudy")
    if not whole:
        (work / "book").mkdir()
        write_json([judged(_case())], {"versions": {"numpy": "9.9"}, "code": "abc"}, work / "book")
        shutil.copy(work / "book" / "verification.json", work / "docs" / "verification.json")
    out = work / "html"
    command = [sys.executable, "-m", "sphinx", "-W", "-q", "-d", work / "trees"]
    made = subprocess.run(
        [*map(str, command), str(work / "docs"), str(out)], capture_output=True, text=True
    )
    assert made.returncode == 0, made.stdout + made.stderr
    return out


def _case() -> CaseResult:
    return CaseResult(
        name=CASES[0].name,
        title="A case of the test",
        method="Two times two.",
        checks=(Check("product", 4.004, 4.0, "mm", "arithmetic", 0.002),),
        tables=(ResultTable("Powers | of two", ("n", "2^n"), ((1, 2.0), (10, 1024.0))),),
        figures=(),
    )
