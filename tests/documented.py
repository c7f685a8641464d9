"""README and the pages by hand, made to run as `docs/executed.py` runs the tutorials.

Their blocks differ from a tutorial's in two ways: they name files that they do not show, which
`given` writes, and `toml` blocks may be fragments of a study, which `whole` completes.
"""

import re
import tomllib
from pathlib import Path

import numpy as np
import trimesh

from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.resources import resource
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(bash|console|toml|python)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
MINE = '[runs.surface]\nsolver = "surface"\n[runs.point]\nsolver = "point"\n'


def given(page: str) -> None:
    """The files that a page only names, into the working directory: `mine.toml` is the user's."""
    if "contactstudy new mine.toml" not in page:
        Path("mine.toml").write_text(f'title = "Mine"\n{MINE}', "utf-8")
    x = np.arange(98080.0, 98160.0, 0.25)
    _rows("level.csv", "chainage_m,left_mm", x, 2.0 * np.sin(x / 3.0) + np.sin(1.0 + x / 0.7))
    s, y = (a.ravel() for a in np.meshgrid(np.linspace(-15, 15, 13), [-35.0, 0.0, 35.0]))
    _rows("flat.csv", "s,y,depth", s, y, 0.1 * np.cos(np.pi * s / 30.0) ** 2)
    y, z = 1e3 * wheel_curve("S1002").point(np.linspace(-0.035, 0.055, 400)).T
    _rows("worn.csv", "y_mm,z_mm", y, z + 0.5 * np.exp(-((y / 15.0) ** 2)))
    t = np.arange(0.0, 6.0, 0.005)
    gauges = [np.exp(-((t - late) ** 2)) for late in (3.0, 3.05)]
    _rows("record.csv", "t,gauge1,gauge2", t, *gauges)
    wave = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    _rows("roughness.csv", "wl,R", wave, 10.0 * np.log10(wave))
    _surface(synthetic_scan(rail_curve("60E1"), 0.03, step=2e-3), 1e3, 0.0, "rail.stl")
    _surface(synthetic_scan(wheel_curve("S1002"), 0.06, step=2e-3), 1.0, 0.070, "tread.ply")


def _rows(name: str, head: str, *columns: np.ndarray) -> None:
    np.savetxt(name, np.c_[columns], fmt="%.6f", delimiter=",", header=head, comments="")


def _surface(mesh: trimesh.Trimesh, scale: float, aside: float, name: str) -> None:
    points = scale * (np.asarray(mesh.vertices) + np.array([0.0, aside, 0.0]))
    trimesh.Trimesh(points, mesh.faces, process=False).export(name)


# first table of a fragment -> the study, shipped with the program, that the page names there
OF_STUDY = {"scan": "s1002_inclined", "measured": "leirelva", "roughness": "trust_map"}
# the tread given is that of another wheel; the stations of a record are the study's
SETTINGS = {
    "scan": ' --set vehicle.wheel_radius="0.46 m"',
    "measured": """ --set 'journey.stations=["14.1 m", "15.1 m"]'""",
}


def whole(page: str, command: str) -> str:
    """The page with each fragment completed to a study, which the command is given.

    A block with runs or positions is a study. Tables of another one take the place of those of
    the study in `OF_STUDY`, or, where the page names none, stand beside two runs.
    """
    number = 0

    def study(found: re.Match) -> str:
        nonlocal number
        block = found[2]
        if found[1] != "toml" or re.match(r"# .*\.toml\n", block):
            return found[0]
        number += 1
        data, name = tomllib.loads(block), f"study_{number}"
        first = next(iter(data))
        if first in OF_STUDY:
            base = resource("studies", f"{OF_STUDY[first]}.toml").read_text("utf-8")
            for table in data:
                base = re.sub(rf"^\[{table}\]\n.*?(?=^\[|\Z)", "", base, flags=re.M | re.S)
            block = f"{base}\n{block}"
        elif not data.keys() & {"runs", "positions"}:
            block = f"{block}\n{MINE}"
        options = f" --out {name}" if command == "run" else ""
        options += " --quick" if "quick" in data or "[quick]" in block else ""
        line = f"contactstudy {command} {name}.toml{options}{SETTINGS.get(first, '')}"
        return f"```toml\n# {name}.toml\n{block}```\n\n```bash\n{line}\n```"

    return BLOCK.sub(study, page)
