"""Study files: find, read, override, and report everything that is wrong with them at once."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from contactstudy.exceptions import InputError
from contactstudy.resources import resource
from contactstudy.study.kinds.passage.reading import load_passage
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.validation import did_you_mean


def shipped_studies() -> dict[str, Path]:
    """Name -> file of the studies that come with the program, in alphabetical order."""
    return {path.stem: path for path in sorted(resource("studies").glob("*.toml"))}


def find_study(study: str | Path) -> Path:
    """Path of a study given by path or by the name of a shipped one.

    Raises
    ------
    InputError
        With close matches when there is no such study.
    """
    path, name = Path(study), str(study)
    if path.is_file():
        return path
    shipped = shipped_studies()
    stem = name.removesuffix(".toml")
    if stem in shipped:
        return shipped[stem]
    hint = did_you_mean(Path(stem).name, shipped)
    raise InputError(
        f"study {name}: no such file nor shipped study{hint}; shipped: {', '.join(shipped)}"
    )


def load_study(
    study: str | Path, overrides: Iterable[str] = (), main: Study | None = None
) -> Study:
    """Read a study file, apply overrides, and check it.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    overrides : iterable of str
        ``key=value`` with dotted keys; values as in TOML, quotes around text may be left out.
    main : Study, optional
        The study that this one accompanies: track, vehicle, journey and solid are taken from
        it where the file has no such table, so that both are about the same wheel and rail.

    Raises
    ------
    InputError
        Listing every problem: unknown keys, wrong units, impossible values.
    """
    path = find_study(study)
    try:
        data = tomllib.loads(path.read_text("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: is not a TOML file ({error})") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from error
    if "positions" in data:
        raise InputError(
            f"study {study}: is a study of positions (table [positions]); only "
            "'contactstudy check', 'run' and 'reproduce' take it"
        )
    return load_passage(path, data, overrides, main)


def load_companions(study: Study) -> list[Study]:
    """Studies that accompany a study, on its track; their own companions are left out.

    Raises
    ------
    InputError
        Listing every problem of every companion.
    """
    found, problems = [], []
    for name in study.companions:
        try:
            found.append(replace(load_study(name, main=study), companions=()))
        except InputError as error:
            problems += [f"companion {name}: {problem}" for problem in error.problems]
    if problems:
        raise InputError(problems)
    return found
