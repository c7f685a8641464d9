"""What a release states: one version, and the licence of every datum that comes with it."""

import re
import tomllib
from fnmatch import fnmatch
from pathlib import Path

from built_site import GENERATED

from contactstudy.version import __version__

ROOT = Path(__file__).parents[2]


def test_the_version_is_that_of_the_citation():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    assert project["project"]["dynamic"] == ["version"]
    pattern = project["tool"]["hatch"]["version"]["pattern"]
    cited = (ROOT / "CITATION.cff").read_text("utf-8")
    assert re.findall(pattern, cited, re.MULTILINE) == [__version__]


def test_every_shipped_datum_is_named_with_its_source():
    page = (ROOT / "docs" / "data.md").read_text("utf-8").partition("## Numbers in the code")[0]
    named = []
    for line in page.splitlines():
        if line.startswith("| `"):
            files = re.findall(r"`([^`]+)`", line.split("|")[1])
            folder = Path(files[0]).parent
            named += [folder / Path(file).name for file in files]
    folders = ("meshes", "vehicles", "studies", "reports/template", "docs", "tests")
    code = {".py", ".pyc", ".md", ".rst", ".html"}
    generated = [f"docs/{made}/*" for made in (*GENERATED, "tutorials/made")] + ["*/__pycache__/*"]
    shipped = [
        path.relative_to(ROOT)
        for folder in folders
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and path.suffix not in code
    ]
    shipped = [p for p in shipped if not any(fnmatch(str(p), g) for g in generated)]
    assert len(shipped) > 40
    missing = [str(p) for p in shipped if not any(fnmatch(str(p), str(n)) for n in named)]
    assert missing == []
    gone = [str(n) for n in named if not any(fnmatch(str(p), str(n)) for p in shipped)]
    assert gone == []
