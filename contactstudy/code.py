"""The code that decides a number: a module and all of the package that it imports."""

from __future__ import annotations

import functools
import hashlib
import re
from pathlib import Path

from contactstudy.resources import resource

PACKAGE = "contactstudy"
LOADING = "contactstudy.study.loading"
"""What imports it may read a shipped study."""
_ROOT = Path(__file__).resolve().parent
# Import statements, inside functions as well. Reading them this way takes a twentieth of the
# time of parsing all modules.
_IMPORT = re.compile(
    rf"^[ \t]*(?:from[ \t]+({PACKAGE}[\w.]*)[ \t]+import[ \t]+(\([^)]*\)|[^\n#]*)"
    rf"|import[ \t]+({PACKAGE}\.[\w.]+))",
    re.MULTILINE,
)
# What only a type checker reads cannot change a number.
_TYPES_ONLY = re.compile(r"^if TYPE_CHECKING:\n(?:[ \t]+[^\n]*\n|\n)+", re.MULTILINE)


@functools.cache
def modules_of(module: str) -> frozenset[str]:
    """Modules of the package that `module` runs, itself included, however far down.

    The package's own ``__init__`` is left out: it is the list of public names and computes
    nothing. Modules that are found by name only while the program runs are not seen; what
    computes must not do that.
    """
    found, waiting = set[str](), [module]
    while waiting:
        name = waiting.pop()
        if name in found or name == PACKAGE or _file(name) is None:
            continue
        found.add(name)
        waiting += [name.rpartition(".")[0], *_imported(name)]
    return frozenset(found)


@functools.cache
def code_digest(module: str | None = None) -> str:
    """Hash of the code that `module` runs, and of the shipped profiles.

    The whole package counts without one, and for a module of somebody else.
    """
    own = module is not None and module.split(".")[0] == PACKAGE
    if module is not None and own:
        files = {name: file for name in modules_of(module) if (file := _file(name))}
        if LOADING in files:
            files |= {f"studies/{path.name}": path for path in resource("studies").glob("*.toml")}
    else:
        files = {path.relative_to(_ROOT).as_posix(): path for path in _ROOT.rglob("*.py")}
        files |= {f"report/{p.name}": p for p in resource("report").glob("*.*")}
    files |= {f"meshes/{path.name}": path for path in resource("meshes").rglob("*.toml")}
    total = hashlib.sha256()
    for name, path in sorted(files.items()):
        total.update(name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()


def _imported(name: str) -> set[str]:
    """What a module imports of the package; of ``from a import b``, both a and a.b."""
    file = _file(name)
    assert file is not None
    text = _TYPES_ONLY.sub("", file.read_text("utf-8"))
    found = set()
    for parent, names, whole in _IMPORT.findall(text):
        found |= {whole} if whole else {parent}
        found |= {f"{parent}.{word}" for word in re.findall(r"\w+", names)}
    return found


@functools.cache
def _file(name: str) -> Path | None:
    """File of a module of the package; None if there is no such module."""
    path = _ROOT.joinpath(*name.split(".")[1:])
    for file in (path.with_suffix(".py"), path / "__init__.py"):
        if file.is_file():
            return file
    return None
