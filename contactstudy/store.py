"""The one store: finished work on disk, found again by a hash of everything that went into it.

An entry ``<name>-<key>`` is a file of content (``.npz``, arrays or a dataset) and a slip
``.json`` with the content's SHA-256 and what else is known about it; plain data stand in the slip
itself. The content is put in place last, so an entry that is there is finished.
"""

from __future__ import annotations

import functools
import hashlib
import json
import re
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from contactstudy.code import code_digest
from contactstudy.files import file_digest, remove_unfinished, write_file, writing
from contactstudy.provenance import COMPUTING, versions
from contactstudy.texts import json_text

if TYPE_CHECKING:
    import xarray as xr

#: Attributes of a run that depend on the machine; they stay out of files that are compared.
MACHINE_ATTRIBUTES = ("seconds_setup", "seconds_stepping", "peak_memory_mb")
_OWN = re.compile(r".+-[0-9a-f]{16,32}\.(npz|nc|json)")


class StoreWarning(UserWarning):
    """An entry was damaged and is made again, or could not be written."""


@dataclass(frozen=True)
class Form:
    """How content is written and read; it is only read when it has the right checksum."""

    suffix: str
    write: Callable[[Any, BinaryIO], None]
    read: Callable[[Path], Any]


@dataclass(frozen=True)
class Kept:
    """What the store has under a key.

    Attributes
    ----------
    value
        None when there is nothing, or nothing whole.
    about
        What was said about it when it was saved.
    damage
        What is wrong with the entry, for the user; "" when nothing is.
    """

    value: Any = None
    about: Mapping[str, Any] = field(default_factory=dict)
    damage: str = ""


def store_key(inputs: Any, code_of: Callable[..., Any] | str | None) -> str:
    """Key of what `inputs`, plain data, make.

    `code_of` is what computes, or its module (`contactstudy.code.code_digest`); None for what all
    of the program decides.
    """
    module = code_of if isinstance(code_of, str) or code_of is None else code_of.__module__
    return digest([inputs, code_digest(module), dict(versions(COMPUTING))])


@dataclass(frozen=True)
class Store:
    """A folder of entries of one form: `ARRAYS`, `DATASET`, or plain data without one."""

    folder: Path
    form: Form | None = None

    def path(self, name: str, key: str) -> Path:
        """File of an entry, there when it is finished."""
        return self.folder / f"{name}-{key}{self.form.suffix if self.form else '.json'}"

    def has(self, name: str, key: str) -> bool:
        """Whether an entry is there; it may still turn out to be damaged."""
        return self.path(name, key).exists()

    def load(self, name: str, key: str) -> Kept:
        """Read an entry."""
        path = self.path(name, key)
        if not path.exists():
            return Kept()
        try:
            slip = json.loads(path.with_suffix(".json").read_text("utf-8"))
            expected, about = slip["sha256"], slip["about"]
            found = digest(slip["value"], 64) if self.form is None else file_digest(path)
            if found != expected:
                return Kept(damage=f"{path}: is damaged (its content does not match its checksum)")
            return Kept(self.form.read(path) if self.form else slip["value"], about)
        except FileNotFoundError:
            return Kept(damage=f"{path}: is damaged (its checksum is missing)")
        except _UNREADABLE:
            return Kept(damage=f"{path}: is damaged (it cannot be read)")

    def about(self, name: str, key: str) -> Mapping[str, Any] | None:
        """What was said about an entry when it was saved; None if it is not there."""
        if not self.has(name, key):
            return None
        try:
            slip = json.loads(self.path(name, key).with_suffix(".json").read_text("utf-8"))
            found: Mapping[str, Any] = slip["about"]
        except _UNREADABLE:
            return None
        return found

    def discard(self, name: str, key: str) -> None:
        """Remove an entry, if it is there."""
        for path in {self.path(name, key), self.path(name, key).with_suffix(".json")}:
            path.unlink(missing_ok=True)

    def whole(self, name: str, key: str) -> Kept:
        """As `load`, without reading content that is a file: its value is True."""
        if self.form is None:
            return self.load(name, key)
        return Store(self.folder, Form(self.form.suffix, self.form.write, lambda path: True)).load(
            name, key
        )

    def save(self, name: str, key: str, value: Any, about: Mapping[str, Any] | None = None) -> Path:
        """Write an entry; `InputError` when the folder cannot be made or written."""
        _tidy(self.folder)
        path, slip = self.path(name, key), dict[str, Any](about=dict(about or {}))
        if self.form is None:
            write_file(path, _plain(slip | {"sha256": digest(value, 64), "value": value}))
            return path
        with writing(path) as stream:
            self.form.write(value, stream)
            sha256 = hashlib.sha256(stream.getbuffer()).hexdigest()
            write_file(path.with_suffix(".json"), _plain(slip | {"sha256": sha256}))
        return path

    def files(self) -> list[Path]:
        """All files of all entries, of any form."""
        if not self.folder.is_dir():
            return []
        return sorted(p for p in self.folder.iterdir() if _OWN.fullmatch(p.name) and p.is_file())

    def summary(self) -> str:
        """Where it is, how many entries it has, and how large they are."""
        files = self.files()
        entries = len({path.stem for path in files})
        size = sum(path.stat().st_size for path in files)
        return f"{self.folder}: {entries} entr{'y' if entries == 1 else 'ies'}, {size / 1e6:.1f} MB"

    def clear(self) -> None:
        """Remove all entries, and nothing else that lies in the folder."""
        for path in self.files():
            path.unlink(missing_ok=True)
        remove_unfinished(self.folder)


@functools.cache
def _tidy(folder: Path) -> None:
    """Remove what killed writers left long ago; once, as looking through a folder takes time."""
    remove_unfinished(folder)


def digest(value: Any, length: int = 16) -> str:
    """Hexadecimal SHA-256 of plain data, cut to `length` characters."""
    text = json_text(value, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:length]


def netcdf_attributes(run: xr.Dataset, drop: tuple[str, ...] = MACHINE_ATTRIBUTES) -> xr.Dataset:
    """Copy of `run` whose attributes netCDF can hold: no None, no booleans, none of `drop`."""
    import numpy as np

    def clean(attrs: dict[Any, Any]) -> dict[str, Any]:
        kept = {str(k): v for k, v in attrs.items() if v is not None and k not in drop}
        return {k: int(v) if isinstance(v, bool | np.bool_) else v for k, v in kept.items()}

    copy = run.copy()
    copy.attrs = clean(run.attrs)
    for variable in copy.variables.values():
        variable.attrs = clean(variable.attrs)
    return copy


def _plain(value: Any) -> str:
    return json_text(value) + "\n"


def _write_arrays(arrays: Mapping[str, Any], stream: BinaryIO) -> None:
    import numpy as np

    np.savez(stream, allow_pickle=False, **arrays)


def _read_arrays(path: Path) -> dict[str, Any]:
    import numpy as np

    with np.load(path, allow_pickle=False) as data:
        return dict(data)


def _write_dataset(data: xr.Dataset, stream: BinaryIO) -> None:
    """Arrays as they are and all else in a header: a tenth of the time that netCDF takes."""
    import numpy as np

    clean, arrays, header = netcdf_attributes(data), dict[str, Any](), dict[str, Any]()
    for number, (name, variable) in enumerate(clean.variables.items()):
        arrays[f"v{number}"] = variable.values
        place = "coords" if name in clean.coords else "data_vars"
        header.setdefault(place, []).append([name, variable.dims, variable.attrs, number])
    header["attrs"] = clean.attrs
    text = json_text(header, default=lambda value: value.tolist())
    np.savez(stream, allow_pickle=False, header=np.array(text), **arrays)


def _read_dataset(path: Path) -> xr.Dataset:
    import numpy as np
    import xarray as xr

    with np.load(path, allow_pickle=False) as found:
        header = json.loads(str(found["header"]))
        parts = {
            place: {
                name: xr.Variable(tuple(dims), found[f"v{number}"], attrs)
                for name, dims, attrs, number in header.get(place, ())
            }
            for place in ("data_vars", "coords")
        }
    return xr.Dataset(**parts, attrs=header["attrs"])


#: A mapping of names to arrays.
ARRAYS = Form(".npz", _write_arrays, _read_arrays)
#: An `xarray.Dataset`.
DATASET = Form(".npz", _write_dataset, _read_dataset)
_UNREADABLE = (
    OSError, ValueError, KeyError, TypeError, RuntimeError, EOFError, ArithmeticError,
    zipfile.BadZipFile,
)  # fmt: skip
