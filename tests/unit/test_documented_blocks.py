"""Every block of README and of the pages by hand runs: shortened here, as it stands if slow.

Of tutorials and gallery the site runs them when it is built.
"""

import contextlib

import pytest
from built_site import docs_module
from documented import BLOCK, PAGES, given, whole

from contactstudy import driver
from contactstudy.workers import InThisProcess

WITH_BLOCKS = [page for page in PAGES if BLOCK.search(page.read_text("utf-8"))]

# a few bays and coarse meshes
WAY = (
    '--set track.length="7.8 m" --set journey.from="3 m" --set journey.to="5 m"'
    ' --set journey.fade_in="0.6 m" --set journey.time_step="200 us" --set solid.mesh_size="5 mm"'
)
PLACES = """--set 'journey.stations=["4.5 m"]' --set 'solid.pressure_at=["4.5 m"]'"""
# what a command of the quick suite gets in addition; the first that begins it
SHORTER = {
    "contactstudy run point_vs_surface": f"{WAY} {PLACES}",
    "contactstudy run mine.toml": f"{WAY} {PLACES}",
    "contactstudy run measured_level": WAY,
    "contactstudy run manchester": "--set positions.lateral=0.0 --set positions.yaw=0.0"
    " --set positions.roll=0.0",
    "contactstudy export": '--set solid.mesh_size="5 mm"',
    "contactstudy verify --quick": "hertz_line",
}
# these take minutes however they are shortened, and have short tests of their own
NOT_QUICK = (
    "contactstudy reproduce",
    "contactstudy run ladder",
    "contactstudy advise",
    "contactstudy verify-advice",
)


def shortened(line):
    if line.startswith(NOT_QUICK):
        return ""
    command, hash_, comment = line.replace("--x 20..24", "--x 4..5").partition(" #")
    added = next((more for start, more in SHORTER.items() if line.startswith(start)), "")
    return f"{command.rstrip()} {added}{hash_}{comment}"


def commands_changed(text, change):
    """The page with another line for each command of the program in its bash blocks."""

    def block(found):
        if found[1] != "bash":
            return found[0]
        lines = [part.strip() for line in found[2].splitlines() for part in line.split("&&")]
        ours = [change(line) for line in lines if line.startswith("contactstudy ")]
        return "```bash\n" + "".join(f"{line}\n" for line in ours) + "```"

    return BLOCK.sub(block, text)


def run_blocks(page, text, folder, monkeypatch):
    monkeypatch.chdir(folder)
    given(text)
    docs_module("executed").run_blocks(page.name, text)


@pytest.mark.parametrize("page", WITH_BLOCKS, ids=[page.name for page in WITH_BLOCKS])
def test_blocks_run(page, tmp_path, monkeypatch):
    """Without figures and reports, and in this process; README's scripts run in `test_face.py`."""
    monkeypatch.setattr(driver, "render", lambda *_: [])
    here = InThisProcess(lambda message: None)
    monkeypatch.setattr(driver, "_executor", lambda *_: contextlib.nullcontext(here))
    text = commands_changed(whole(page.read_text("utf-8"), "check"), shortened)
    if page.name == "README.md":
        text = BLOCK.sub(lambda found: "" if found[1] == "python" else found[0], text)
    run_blocks(page, text, tmp_path, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("page", WITH_BLOCKS, ids=[page.name for page in WITH_BLOCKS])
def test_blocks_run_as_they_stand(page, tmp_path, monkeypatch):
    """But for promises on ten random studies instead of a hundred, which take an hour."""
    text = whole(page.read_text("utf-8"), "run")
    text = commands_changed(text, lambda line: line.replace("--draws 100", "--draws 10"))
    run_blocks(page, text, tmp_path, monkeypatch)
