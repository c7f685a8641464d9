"""Files that come with the program: profiles and mesh recipes, studies, report template."""

from pathlib import Path

from contactstudy.exceptions import InputError

_PACKAGE = Path(__file__).resolve().parent
# name -> (inside an installed package, at the top of a source tree)
_ROOTS = {
    "meshes": (_PACKAGE / "data" / "meshes", _PACKAGE.parent / "meshes"),
    "studies": (_PACKAGE / "data" / "studies", _PACKAGE.parent / "studies"),
    "report": (_PACKAGE / "data" / "report", _PACKAGE.parent / "reports" / "template"),
}


def resource(*parts: str) -> Path:
    """Path of a file or folder that is shipped with the program.

    The first of its parts is ``"meshes"``, ``"studies"`` or ``"report"``; it exists, in the
    installed package or, for an editable install, the source tree, or is an ``InputError``.
    """
    if not parts or parts[0] not in _ROOTS:
        given = parts[0] if parts else ""
        raise InputError(f"resource '{given}' is unknown; allowed: {', '.join(sorted(_ROOTS))}")
    for root in _ROOTS[parts[0]]:
        path = root.joinpath(*parts[1:])
        if path.exists():
            return path
    raise InputError(f"{'/'.join(parts)}: no such file is shipped with contactstudy")
