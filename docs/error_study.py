"""The error study as data of the page "How wrong is point contact".

    contactstudy run error_study --out errors
    python docs/error_study.py errors

writes ``docs/error_study.json`` and the figures beside it, which are kept; the site's build makes
the page of them. Sentences, tables and captions are those of the report. Several folders, each with
one of the studies, do as well; what another command than ``contactstudy run NAME`` made is given as
``FOLDER=COMMAND``.
"""

import json
import shutil
import sys
from pathlib import Path

from PIL import Image

from contactstudy.report.content import content
from contactstudy.study.results import StudyResults, read_results

DATA, FIGURES = "error_study.json", "error_study"
_WIDTH = 1000
"""Pixels of a figure."""
_ASIDE = ("irregularity_", "rail_", "wheel_", "patch_", "static_press")
"""Beginnings of the names of figures that stand in the reports only."""


def compact(results: StudyResults, command: str) -> dict:
    """What the page says of one study: its abstract, conclusion and figures."""
    own = content(results, timings=False)
    blocks = [block for part in own["results"] for block in part["blocks"]]
    drawn = [_figure(results.name, b) for b in blocks if b["kind"] == "figure"]
    return {
        "name": results.name,
        "title": results.title,
        "command": command or f"contactstudy run {results.name}",
        "description": " ".join(results.description.split()),
        "told": own["abstract"],
        "conclusion": own["conclusion"],
        "figures": [f for f in drawn if not f["name"].startswith(_ASIDE)],
        "versions": results.provenance["versions"],
        "code": results.provenance["code"],
    }


def _figure(study: str, block: dict) -> dict:
    name = Path(block["file"]).stem
    return {"name": name, "file": f"{study}-{name}.png", "caption": block["caption"]}


def shrink(source: Path, target: Path) -> None:
    """A figure of 256 colours, no wider than a page needs."""
    with Image.open(source) as picture:
        height = round(picture.height * min(1.0, _WIDTH / picture.width))
        small = picture.convert("RGB").resize((min(_WIDTH, picture.width), height), Image.LANCZOS)
        small.quantize(256, kmeans=2).save(target, optimize=True)


def page(studies: list[dict]) -> str:
    """The page in Markdown."""
    parts = [
        "# How wrong is point contact",
        "What the studies of the error found, and why. Sentences, figures and numbers on this page "
        "are those of their reports; none is typed. Errors are those against surface contact of "
        "this program, and none of them is the paper's.",
    ]
    for study in studies:
        parts += [f"## {study['title']}", _plain(study["description"])]
        parts += ["\n".join(f"- {_plain(text)}" for text in study["told"])]
        parts += [_block(block) for block in study["conclusion"]]
        for figure in study["figures"]:
            parts.append(f"![{study['title']}]({FIGURES}/{figure['file']})")
            if figure["caption"] not in study["told"]:
                parts.append(f"*{_plain(figure['caption'])}*")
        versions = ", ".join(f"{name} {number}" for name, number in study["versions"].items())
        parts.append(f"`{study['command']}`, computed with {versions}; code {study['code']}.")
    return "\n\n".join(parts) + "\n"


def _block(block: dict) -> str:
    if block["kind"] == "text":
        return _plain("".join(part.get("text", "") for part in block["parts"]))
    if block["kind"] == "list":
        return "\n".join(f"- {_plain(item)}" for item in block["items"])
    rows = [[c["title"] for c in block["columns"]], *block["rows"]]
    marks = ["---:" if c["align"] == "right" else "---" for c in block["columns"]]
    lines = [" | ".join(_plain(cell).replace("|", "\\|") for cell in row) for row in rows]
    lines.insert(1, " | ".join(marks))
    return "\n".join(f"| {line} |" for line in lines) + f"\n\n*{_plain(block['caption'])}*"


def _plain(text: str) -> str:
    """Text in which nothing is markup."""
    return "".join(f"\\{c}" if c in "\\`*_{}[]<>#$" else c for c in text)


def gather(given: list[str], docs: Path) -> None:
    """Write data and figures of the studies in folders, and of those that a folder gathers."""
    shutil.rmtree(docs / FIGURES, ignore_errors=True)
    (docs / FIGURES).mkdir()
    made = []
    for text in given:
        folder, _, command = text.partition("=")
        results = read_results(folder)
        gathered = not results.runs and not results.swept
        places = [(c, Path(folder) / c.name) for c in results.companions] if gathered else []
        for study, place in places or [(results, Path(folder))]:
            made.append(compact(study, command))
            for figure in made[-1]["figures"]:
                shrink(place / "figures" / f"{figure['name']}.png", docs / FIGURES / figure["file"])
    (docs / DATA).write_text(json.dumps(made, separators=(",", ":")) + "\n", "utf-8")


if __name__ == "__main__":
    gather(sys.argv[1:], Path(__file__).parent)
