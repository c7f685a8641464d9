"""Study files: find, read, override, and report everything that is wrong with them at once."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.resources import resource
from contactstudy.study.kind import kind_of_file
from contactstudy.study.overrides import Overrides
from contactstudy.validation import complaint, did_you_mean, raise_if

# of a study's results, beside which those of its companions lie
_TAKEN = (
    "runs", "figures", "fields", "result.nc", "metrics.json", "report.pdf", "patches.csv",
)  # fmt: skip


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
    if not isinstance(study, str | Path):
        raise InputError(f"study = {study!r}: must be a file or the name of a shipped study")
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


def load_study(study: str | Path, overrides: Overrides = (), main: Any = None) -> Any:
    """Read a study file of any kind, apply overrides, and check it.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    overrides : iterable of str, or mapping
        See `contactstudy.study.overrides`.
    main : Study, optional
        The study that this one accompanies: a passage takes track, vehicle, journey and solid
        from it where the file has no such table, so that both are about the same wheel and rail.

    Returns
    -------
    Study
        Of the kind that the file's tables tell, see `contactstudy.study.kind`.

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
    kind = kind_of_file(data)
    same = main is not None and main.kind == kind.name
    return kind.load(path, data, overrides, main if same else None)


def load_companions(study: Any) -> list[Any]:
    """Studies that accompany a study, on its track; their own companions are left out.

    Raises
    ------
    InputError
        Listing every problem of every companion.
    """
    found, problems = [], []
    taken = dict.fromkeys(_TAKEN, "a file or folder of every study")
    taken[study.name] = "the study that it accompanies"
    for name in study.companions:
        try:
            made = replace(load_study(name, main=study), companions=())
        except InputError as error:
            problems += [f"companion {name}: {problem}" for problem in error.problems]
            continue
        if made.name in taken:
            problems.append(
                f"companion {name}: is called {made.name} like {taken[made.name]}; its results "
                "go into a folder of that name, so give its file another one"
            )
        taken[made.name] = f"the companion {name}"
        found.append(made)
    raise_if(problems)
    return found


def title_and_description(name: str, data: Mapping[str, Any]) -> tuple[dict[str, str], list[str]]:
    """Texts that a study file of any kind may have, and what is wrong with them."""
    texts = {"title": data.get("title", name), "description": data.get("description", "")}
    problems = [
        complaint(key, value, "must be text")
        for key, value in texts.items()
        if not isinstance(value, str)
    ]
    return texts, problems
