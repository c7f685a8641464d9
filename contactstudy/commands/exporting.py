"""The command that writes input files for other programs."""

from __future__ import annotations

from pathlib import Path

from contactstudy.commands.options import Out, Overrides


def export(
    study: Path,
    *,
    out: Out,
    run: str | None = None,
    load: str | None = None,
    rail_length: str | None = None,
    overrides: Overrides = (),
) -> None:
    """Write the static press of wheel on rail as an input file for CalculiX.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    out
        File to write; solve it with ccx NAME, without the ending .inp.
    run
        Run of surface contact; the reference, or the first, when not given.
    load
        Wheel load, e.g. "80 kN"; the static load when not given.
    rail_length
        Length of the clamped rail, e.g. "0.6 m"; four rail cells when not given.
    """
    from contactstudy.study.kind import find_kind
    from contactstudy.study.loading import load_study

    loaded = load_study(study, overrides)
    options = {"run": run, "load": load, "rail_length": rail_length}
    print(find_kind(loaded.kind).export(loaded, out, **options))
