"""Objects that name input files, pickled with the content of these files."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import pickle
from collections.abc import Iterator
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from contactstudy.files import write_file
from contactstudy.given_files import changed, file_content, is_file
from contactstudy.validation import Parameters, parameters

_folder: ContextVar[Path] = ContextVar("folder")


class Carrying(pickle.Pickler):
    """Pickles; files named by fields that are annotated with `File` go with their objects."""

    def reducer_override(self, obj: Any) -> Any:
        """Give up an object as its class, its fields, and the content of files among them."""
        if not isinstance(obj, Parameters):
            return NotImplemented
        named = {p.name: getattr(obj, p.name) for p in parameters(type(obj)) if p.file}
        files = {
            name: (path.name, _content(path, changed(path)))
            for name, value in named.items()
            if value and isinstance(value, str) and is_file(path := Path(value))
        }
        return (_received, (type(obj), dict(vars(obj)), files)) if files else NotImplemented


@contextlib.contextmanager
def receiving(folder: Path) -> Iterator[None]:
    """Objects that are unpickled meanwhile have their files in `folder`."""
    token = _folder.set(folder)
    try:
        yield
    finally:
        _folder.reset(token)


def _received(owner: type, values: dict[str, Any], files: dict[str, tuple[str, bytes]]) -> Any:
    made: Any = object.__new__(owner)
    for field, (name, content) in files.items():
        path = _folder.get() / hashlib.sha256(content).hexdigest()[:16] / name
        if not path.exists():
            write_file(path, content)
        values[field] = str(path)
    vars(made).update(values)
    return made


@functools.lru_cache(maxsize=16)
def _content(path: Path, changed: int) -> bytes:
    """Content of a file; of one that has changed it is read again."""
    return file_content(path)
