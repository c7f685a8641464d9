"""Run CalculiX on an exported press, one thread, in a folder of its own."""

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.verification.cases.calculix_results import CalculixPress, read_presses

PROGRAM = "ccx"


@dataclass(frozen=True)
class CalculixRun:
    """What a run gave and cost.

    Attributes
    ----------
    presses : tuple of CalculixPress
        Of the load steps.
    solutions : int
        Systems of equations solved.
    cpu_seconds : float
        Processor time of the whole run, on one thread.
    """

    presses: tuple[CalculixPress, ...]
    version: str
    solutions: int
    cpu_seconds: float

    @property
    def press(self) -> CalculixPress:
        """Of the last step."""
        return self.presses[-1]


def calculix_version() -> str:
    """Version of the CalculiX installed, e.g. "2.20".

    Raises
    ------
    InputError
        If there is none.
    """
    if shutil.which(PROGRAM) is None:
        raise InputError(
            f"program {PROGRAM}: not found; CalculiX is in Debian's package calculix-ccx"
        )
    said = subprocess.run([PROGRAM, "-v"], capture_output=True, text=True, check=False).stdout
    found = re.search(r"[Vv]ersion\s+(\S+)", said)
    return found.group(1) if found else "unknown"


def run_calculix(
    text: str, penalty: float, symmetric: bool = True, timeout: float = 3600.0
) -> CalculixRun:
    """Solve an input file of `calculix_input`.

    Parameters
    ----------
    penalty : float
        That it was written with, in Pa/m.
    symmetric : bool
        It is a half model.
    timeout : float
        In s of wall time.

    Raises
    ------
    InputError
        If CalculiX is not installed.
    NumericalError
        If it does not finish.
    """
    version = calculix_version()
    with tempfile.TemporaryDirectory() as name:
        began = os.times()
        results, said = solve_in(Path(name), text, timeout)
        ended = os.times()
        return CalculixRun(
            presses=read_presses(results, penalty, symmetric),
            version=version,
            solutions=said.count("Factoring the system"),
            cpu_seconds=(ended.children_user - began.children_user)
            + (ended.children_system - began.children_system),
        )


def solve_in(folder: Path, text: str, timeout: float = 3600.0) -> tuple[Path, str]:
    """Solve an input file in a folder: its results (.dat) and what CalculiX said.

    Raises
    ------
    NumericalError
        If it does not finish within `timeout` [s].
    """
    (folder / "press.inp").write_text(text, "ascii")
    try:
        done = subprocess.run(
            [PROGRAM, "press"],
            cwd=folder,
            env=os.environ | {"OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            errors="replace",
            timeout=timeout,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        raise NumericalError(f"CalculiX: not finished within {timeout:g} s") from error
    if done.returncode != 0:
        last = " ".join(done.stdout.split()[-20:])
        raise NumericalError(f"CalculiX: stopped with status {done.returncode}: ... {last}")
    return folder / "press.dat", done.stdout
