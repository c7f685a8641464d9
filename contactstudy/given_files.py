"""The one place where files that a user names are opened."""

import codecs
import hashlib
import stat
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError, reason
from contactstudy.validation.messages import did_you_mean

LARGEST = 2**30
"""Bytes of the largest file that is read."""
LARGEST_TEXT = 2**28
"""Bytes of the largest text file."""
DEEPEST = 20
"""Levels of tables and lists in a TOML file."""

# the longer mark first: that of UTF-32 begins as that of UTF-16
_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def is_file(path: str | Path) -> bool:
    """Whether there is a regular file of that name; names that no file can have have none."""
    try:
        return stat.S_ISREG(Path(path).stat().st_mode)
    except (OSError, ValueError):
        return False


def file_content(path: str | Path, largest: int = LARGEST) -> bytes:
    """Content of a regular file.

    Raises
    ------
    InputError
        For a name that no file can have, no such file, a folder or device, one that may not be
        read, or more bytes than `largest`.
    """
    file = Path(path)
    if "\0" in str(file):
        raise InputError(f"{str(file)!r}: cannot be read (a zero byte in the name)")
    try:
        status = file.stat()
        if not stat.S_ISREG(status.st_mode):
            kind = "a folder" if stat.S_ISDIR(status.st_mode) else "a device or pipe"
            raise InputError(f"{file}: cannot be read (it is {kind}, not a file)")
        if status.st_size > largest:
            raise InputError(
                f"{file}: is {status.st_size / 2**20:.4g} MiB large; allowed: up to "
                f"{largest / 2**20:g} MiB"
            )
        return file.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{file}: there is no such file") from None
    except OSError as error:
        name = str(file) if len(str(file)) < 300 else f"{str(file)[:100]}..."
        raise InputError(f"{name}: cannot be read ({reason(error)})") from None


def content_digest(path: str | Path) -> str:
    """Hexadecimal SHA-256 of a regular file's content; `InputError` as `file_content`."""
    return hashlib.sha256(file_content(path)).hexdigest()


def changed(path: str | Path) -> int:
    """When a file changed last [ns], so that what was read of it is read again; 0 without one."""
    return Path(path).stat().st_mtime_ns if is_file(path) else 0


def file_text(path: str | Path, kind: str = "text", fallback: str = "") -> str:
    """Text of a file in UTF-8, or as its byte order mark says, with ``\\n`` at the line ends.

    `fallback` names the encoding of files that are not UTF-8; without one they are refused, as is
    any file with zero characters, "not a `kind` file".
    """
    content = file_content(path, LARGEST_TEXT)
    mark, encoding = next((m for m in _MARKS if content.startswith(m[0])), (b"", "utf-8"))
    try:
        text = content.removeprefix(mark if encoding == "utf-8" else b"").decode(encoding)
    except UnicodeDecodeError:
        if not fallback or mark:
            raise InputError(
                f"{path}: this is not a {kind} file in UTF-8 (save it in that encoding)"
            ) from None
        text = content.decode(fallback)
    if "\0" in text:
        raise InputError(f"{path}: this is not a {kind} file (it has zero characters)")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def named_file(name: str, shipped: Mapping[str, Path], what: str) -> Path:
    """The TOML file of a name: a user's own by its ending, else one that is shipped."""
    path = Path(name)
    if path.suffix == ".toml":
        return path
    if name not in shipped:
        raise InputError(
            f'{what} "{name}" is unknown{did_you_mean(name, shipped)}; allowed: '
            f"{', '.join(shipped)}, or a file ending in .toml"
        )
    return shipped[name]


def toml_file(path: str | Path) -> dict[str, Any]:
    """Content of a TOML file; ``InputError`` if it is none, or nested too deep."""
    try:
        data = tomllib.loads(file_text(path, "TOML"))
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: is not a TOML file ({error})") from None
    except ValueError:  # Python refuses to read integers of thousands of digits
        raise InputError(f"{path}: is not a TOML file (a number with too many digits)") from None
    except RecursionError:
        data = None
    if data is None or _depth(data) > DEEPEST:
        raise InputError(f"{path}: is nested too deep; allowed: {DEEPEST} levels")
    return data


def _depth(data: Any) -> int:
    """Levels of tables and lists within each other."""
    depth, level = 0, [data]
    while level:
        depth += 1
        inner: list[Any] = []
        for item in level:
            held: Iterable[Any] = item.values() if isinstance(item, dict) else item
            inner += [one for one in held if isinstance(one, dict | list)]
        level = inner
    return depth
