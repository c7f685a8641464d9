"""Study files: find, read, override, and report everything that is wrong with them at once."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError, gathered
from contactstudy.files import is_reserved
from contactstudy.given_files import is_file, toml_file
from contactstudy.resources import shipped
from contactstudy.study.axes.keys import TABLES, apply_quick, without_keys, wrong_alone
from contactstudy.study.axes.swept import Source, Swept
from contactstudy.study.axes.table import read_designs
from contactstudy.study.kind import Kind, find_kind, kind_of_file
from contactstudy.study.overrides import Overrides, read_texts
from contactstudy.study.results import OUTPUTS
from contactstudy.validation import complaint, did_you_mean, raise_if


def shipped_studies() -> dict[str, Path]:
    """Name -> file of the studies that come with the program, in alphabetical order."""
    return shipped("studies")


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
    if is_file(path):
        return path
    ours = shipped_studies()
    stem = name.removesuffix(".toml")
    if stem in ours:
        return ours[stem]
    hint = did_you_mean(Path(stem).name, ours)
    raise InputError(
        f"study {name}: no such file nor shipped study{hint}; shipped: {', '.join(ours)}"
    )


def load_study(
    study: str | Path,
    overrides: Overrides = (),
    main: Any = None,
    *,
    sweep: Overrides = (),
    quick: bool = False,
) -> Any:
    """Read a study file of any kind, apply overrides, and check it.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    overrides : iterable of str, or mapping
        See `contactstudy.study.overrides`. A key that the file sweeps or refines stays at the
        value given here.
    main : Study, optional
        The study that this one accompanies: a passage takes track, vehicle, journey and solid
        from it where the file has no such table, so that both are about the same wheel and rail.
    sweep : iterable of str, or mapping
        Series of further keys, in place of the file's, as in the table ``[sweep]``.
    quick : bool
        With the values of the table ``[quick]``.

    Returns
    -------
    Study
        Of the kind that the file's tables tell, see `contactstudy.study.kind`; a `Swept` one with
        axes.

    Raises
    ------
    InputError
        Listing every problem: unknown keys, wrong units, impossible values.
    """
    path = find_study(study)
    data = toml_file(path)
    kind = kind_of_file(data)
    main = main if main is not None and main.kind == kind.name else None
    given, problems = read_texts(overrides, "--set", kind.tables, kind.inner_tables)
    series, wrong = read_texts(sweep, "--sweep", {}, {})
    wrong += [
        f"{key}: is set ({given[key]}) and swept ({series[key]}) at once; give --set or --sweep"
        for key in given
        if key in series
    ]
    return _with_axes(path, data, kind, main, (given, series), problems + wrong, quick)


def _with_axes(
    path: Path,
    data: dict[str, Any],
    kind: Kind,
    main: Any,
    options: tuple[dict[str, Any], dict[str, Any]],
    problems: list[str],
    quick: bool,
) -> Any:
    """The study that a file's content describes, with its axes if it has any.

    `options` are values and series that stand in place of the file's; further `problems` are
    included.
    """
    given, sweep = options
    axes = {name: data.pop(name) for name in TABLES if name in data}
    no_tables = {name: t for name, t in axes.items() if not isinstance(t, dict)}
    problems += [complaint(name, t, "must be a table") for name, t in no_tables.items()]
    axes = {name: t for name, t in axes.items() if name not in no_tables}
    quickly = apply_quick(axes if quick else deepcopy(axes), axes.pop("quick", {}))
    fixed = (quickly if quick else {}) | given
    for name in ("sweep", "refine"):
        axes[name] = without_keys(axes.get(name, {}), given.keys() | sweep.keys())
    axes["sweep"] |= sweep
    source = Source(kind, path, deepcopy(data), fixed, None if main is None else base_of(main))
    designs, keep, wrong = read_designs(data | axes, kind, path.parent)
    study, of_file = None, list[str]()
    with gathered(of_file):
        study = source.load({})
    if study is None or problems or wrong:  # its axes and companions can only be looked at alone
        own = [(k, v) for d in designs for k, s in d.series.items() for v in s.values]
        of_file += wrong_alone("sweep", own, kind, data) + _no_companions(data)
        of_file += wrong_alone("quick", quickly.items(), kind, data)
    elif quickly and not quick:
        with gathered(of_file, "quick: "):
            source.load(quickly | given)
    raise_if(dict.fromkeys(problems + of_file + wrong))
    if not designs:
        return study
    made = Swept.of(study, designs, source, keep)
    # impossible variants are refused, and histories that none of them has
    raise_if(_unknown_histories(kind, [v.study for v in made.variants.values()], keep))
    return made


def _no_companions(data: dict[str, Any]) -> list[str]:
    """Complaints about companions of a study that cannot be read, which do not exist."""
    named, problems = data.get("companions"), list[str]()
    for name in named if isinstance(named, list) else ():
        with gathered(problems, f"companion {name}: "):
            find_study(name)
    return problems


def _unknown_histories(kind: Kind, studies: Sequence[Any], keep: Sequence[str]) -> list[str]:
    """Complaints about histories to keep that no run of any variant has."""
    known: dict[str, None] = {}
    for study in studies:
        if all(name in known for name in keep):
            return []
        found = kind.histories(study)
        if found is None:
            return []
        known |= dict.fromkeys(found)
    return [
        complaint("sweep.keep", name, f"no run has this history{did_you_mean(name, known)}")
        + f"; there are {', '.join(known)}"
        for name in keep
        if name not in known
    ]


def base_of(study: Any) -> Any:
    """A study without its axes."""
    return study.study if isinstance(study, Swept) else study


def load_companions(study: Any, quick: bool = False, last: bool = False) -> list[Any]:
    """Studies that accompany a study, on its track.

    With `quick` they have the values of their tables ``[quick]``. The `last` ones, companions of a
    companion, have none themselves.

    Raises
    ------
    InputError
        Listing every problem of every companion.
    """
    found, problems = list[Any](), list[str]()
    files = (*OUTPUTS, *find_kind(study.kind).files)
    # some disks do not tell capitals
    taken = dict.fromkeys(map(str.lower, files), "a file or folder of the results")
    taken[study.name.lower()] = "the study that it accompanies"
    for name in study.companions:
        made = None
        with gathered(problems, f"companion {name}: "):
            made = load_study(name, main=study, quick=quick)
        if made is None:
            continue
        made = replace(made, companions=()) if last else made
        like = "a device of Windows" if is_reserved(made.name) else taken.get(made.name.lower())
        if like:
            problems.append(
                f"companion {name}: is called {made.name} like {like}; its results "
                "go into a folder of that name, so give its file another one"
            )
        taken[made.name.lower()] = f"the companion {name}"
        found.append(made)
    raise_if(problems)
    return found
