"""Files that come with the program: profiles, meshes, vehicles, studies, report template."""

from pathlib import Path

from contactstudy.exceptions import InputError

_PACKAGE = Path(__file__).resolve().parent
# name -> (inside an installed package, at the top of a source tree)
_ROOTS = {
    "meshes": (_PACKAGE / "data" / "meshes", _PACKAGE.parent / "meshes"),
    "vehicles": (_PACKAGE / "data" / "vehicles", _PACKAGE.parent / "vehicles"),
    "studies": (_PACKAGE / "data" / "studies", _PACKAGE.parent / "studies"),
    "report": (_PACKAGE / "data" / "report", _PACKAGE.parent / "reports" / "template"),
}


def resource(kind: str, *parts: str) -> Path:
    """Path of a file or folder that is shipped with the program.

    The kind is ``"meshes"``, ``"vehicles"``, ``"studies"`` or ``"report"``. It exists, in the
    installed package or, for an editable install, the source tree; an ``InputError`` if there is
    none.
    """
    if kind not in _ROOTS:
        raise InputError(f"resource '{kind}' is unknown; allowed: {', '.join(sorted(_ROOTS))}")
    for root in _ROOTS[kind]:
        path = root.joinpath(*parts)
        if path.exists():
            return path
    raise InputError(f"{'/'.join((kind, *parts))}: no such file is shipped with contactstudy")


def shipped(*parts: str) -> dict[str, Path]:
    """Name -> TOML file in a folder of `resource`, in alphabetical order."""
    return {path.stem: path for path in sorted(resource(*parts).glob("*.toml"))}
