"""Whatever is given, `check` answers: no traceback, in bounded time and memory, naming its place.

Mutants are numbered: `mutated(seed, ...)` of checking.py makes the one that failed again.
"""

from concurrent.futures import ProcessPoolExecutor

import pytest
from bases import STUDIES, write_bases
from checking import NAMES, fault, faults

from contactstudy.cli import main

QUICK, MANY, SHARE = 30, 600, 50


@pytest.fixture(scope="session")
def bases(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bases")
    write_bases(folder)
    return folder


@pytest.mark.parametrize("study", STUDIES)
def test_what_mutants_are_made_of_is_sound(bases, study, capsys):
    assert main(["check", str(bases / f"{study}.toml")]) == 0, capsys.readouterr().err


@pytest.mark.parametrize("study", NAMES)
def test_some_mutants_of_each_kind(bases, study, tmp_path):
    """Seeds that the many do not have."""
    first = MANY + (NAMES.index(study) - MANY) % len(NAMES)
    seeds = range(first, first + QUICK // len(NAMES) * len(NAMES), len(NAMES))
    found = [fault(seed, bases, tmp_path / str(seed)) for seed in seeds]
    assert not any(found), "\n".join(filter(None, found))


@pytest.mark.slow
def test_many_mutants(bases, tmp_path):
    starts = range(0, MANY, SHARE)
    with ProcessPoolExecutor(2) as pool:
        calls = [pool.submit(faults, k, k + SHARE, bases, tmp_path) for k in starts]
        found = [text for call in calls for text in call.result()]
    assert not found, "\n\n".join(found)
