"""`contactstudy check` of a mutant in this process, under limits of time and memory."""

import contextlib
import io
import os
import re
import resource
import shutil
import signal
import sys
import traceback
from pathlib import Path
from random import Random

from mutations import OF_STUDY, place

from contactstudy.cli import main
from contactstudy.process import forget_peak_memory, peak_memory_mb

SECONDS, MEGABYTES = 20.0, 2000.0
NAMES = tuple(OF_STUDY)


class TooLongError(Exception):
    """More processor time than allowed."""


def mutated(seed: int, bases: Path, folder: Path) -> tuple[str, str]:
    """Make the mutant of a seed in a new folder; the study's name, and what was done to it."""
    random = Random(seed)
    study = NAMES[seed % len(NAMES)]
    shutil.copytree(bases, folder)
    done = []
    for _ in range(random.choice((1, 1, 1, 2))):
        mutation = random.choice(OF_STUDY[study])
        # what the first has left may be nothing that the second can read
        with contextlib.suppress(OSError, ValueError, IndexError, KeyError, AttributeError):
            mutation(folder, study, random)
        done.append(mutation.__name__)
        if mutation is place:  # a pipe or a device: nothing to read for a second one
            break
    return study, " and ".join(done)


def fault(seed: int, bases: Path, folder: Path) -> str:
    """What is wrong with the answer to a mutant, "" for nothing."""
    study, done = mutated(seed, bases, folder)
    fault = _fault_of_answer(folder / f"{study}.toml")
    shutil.rmtree(folder)
    return f"mutant {seed} of {study} ({done}): {fault}" if fault else ""


def _fault_of_answer(file: Path) -> str:
    said, printed = io.StringIO(), io.StringIO()
    signal.signal(signal.SIGPROF, _too_long)
    forget_peak_memory()
    before = os.times()
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(printed):
            status = main(["check", str(file)])
    except TooLongError:
        return f"more than {SECONDS:g} s\n{traceback.format_exc()[-1500:]}"
    except BaseException:
        return traceback.format_exc()[-3000:]
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    after, peak = os.times(), peak_memory_mb()
    if peak is not None and peak > MEGABYTES:
        return f"{peak:.0f} MB after {after.user - before.user:.1f} s"
    text = said.getvalue()
    if status == 0:
        return "" if printed.getvalue().strip() else "nothing is printed"
    if status != 2:
        return f"exit status {status}: {text[:500]}"
    # a file, or a key with dots or a table's name, stands in every complaint
    for complaint in filter(None, text.removeprefix("contactstudy: ").splitlines()):
        named = re.match(r"\s*(\S*[./]\S*|[a-z_]+[:= ])", complaint)
        if not named or "Traceback" in complaint:
            return f"names neither key nor file: {complaint[:300]}"
    return ""


def _too_long(number: int, frame: object) -> None:
    raise TooLongError


def faults(first: int, last: int, bases: Path, folder: Path) -> list[str]:
    """Faults of the answers to mutants."""
    sys.setrecursionlimit(1000)
    # what asks for much more than is allowed gets a MemoryError, not the machine
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_DATA, (6_000_000_000, resource.RLIM_INFINITY))
    found = [fault(seed, bases, folder / str(seed)) for seed in range(first, last)]
    return [one for one in found if one]
