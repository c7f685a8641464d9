"""Files that are either whole or not there: the only way anything of the package is written."""

from __future__ import annotations

import contextlib
import errno
import functools
import hashlib
import io
import os
import platform
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from contactstudy.exceptions import InputError, StorageError, reason

#: Marks a temporary file as ours.
_UNFINISHED = ".unfinished-"
_ABANDONED = 3600.0  # s
LONGEST_NAME = 100
"""Characters of a name that files are called by; with what is added, most disks take 255 bytes."""
# https://learn.microsoft.com/windows/win32/fileio/naming-a-file
_DEVICES = {"con", "prn", "aux", "nul", *(f"{d}{n}" for d in ("com", "lpt") for n in range(1, 10))}
_LONGEST_SHOWN = 300  # characters of a path in a message
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


def write_file(path: Path, content: bytes | memoryview | str) -> None:
    """Put `content`, text in UTF-8, beside `path` and rename it; its folder is made when absent.

    Raises
    ------
    InputError
        If the folder cannot be made or written.
    StorageError
        If there is no room; what was there before stays.
    """
    data = content.encode() if isinstance(content, str) else content
    temporary: Path | None = None
    try:
        with _said_of(path, len(data)):
            path.parent.mkdir(parents=True, exist_ok=True)
            prefix = f"{_UNFINISHED}{_node()}-{os.getpid()}-"
            handle, name = tempfile.mkstemp(dir=path.parent, prefix=prefix)
            temporary = Path(name)
            with open(handle, "wb") as stream:  # noqa: PTH123 - it is open already
                stream.write(data)
            umask = os.umask(0)
            os.umask(umask)
            temporary.chmod(0o666 & ~umask)  # mkstemp makes files that only their owner can read
            temporary.replace(path)
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def writing(path: Path) -> Iterator[io.BytesIO]:
    """Give a stream in memory; when the block succeeds, its content becomes the file `path`.

    So no library writes on a disk: on a full one, some crash (h5py) and some write half a file.
    """
    stream = io.BytesIO()
    yield stream
    with stream.getbuffer() as content:
        write_file(path, content)


def remove_unfinished(directory: Path) -> None:
    """Remove what writers left that were killed.

    Of writers that may live, as those on other machines, what is an hour old.
    """
    for path in directory.glob(f"{_UNFINISHED}*"):
        with contextlib.suppress(OSError):  # its writer has ended meanwhile, or is somebody else
            if _has_ended(path) or path.stat().st_mtime <= time.time() - _ABANDONED:
                path.unlink()


def _has_ended(path: Path) -> bool:
    """Whether the writer of an unfinished file was a process here that is no more."""
    node, _, rest = path.name.removeprefix(_UNFINISHED).partition("-")
    number = rest.partition("-")[0]
    if os.name != "posix" or node != _node() or not number.isdecimal():
        return False
    try:
        os.kill(int(number), 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):  # somebody else's
        return False
    return False


@functools.cache
def _node() -> str:
    """Stands for the machine in names of files."""
    return hashlib.sha256(platform.node().encode()).hexdigest()[:8]


@contextlib.contextmanager
def alone(path: Path, told: Callable[[str], None] = lambda holder: None) -> Iterator[None]:
    """Meanwhile no other process makes `path`; `told` hears for which one this one has to wait.

    A process that is killed gives way at once. Where files cannot be locked (Windows, some network
    file systems), others may do the same work at the same time: each file is whole all the same.
    """
    lock = path.with_name(f".{path.name}.lock")
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(ImportError, OSError):
            lock.parent.mkdir(parents=True, exist_ok=True)
            stack.enter_context(_locked(lock, told))
            stack.callback(_remove, lock)
        yield


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()


def _locked(lock: Path, told: Callable[[str], None]) -> io.FileIO:
    """The locked file; it says who has locked it."""
    import fcntl

    while True:
        stream = io.FileIO(lock, "a+")
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            stream.seek(0)
            told(stream.read(200).decode(errors="replace") or "another process")
            fcntl.flock(stream, fcntl.LOCK_EX)
        if _is_there(lock, stream):  # not removed by who had it before
            break
        stream.close()
    with contextlib.suppress(OSError):  # on a full disk
        stream.truncate(0)
        stream.write(f"process {os.getpid()} on {platform.node()}".encode())
    return stream


def _is_there(path: Path, stream: io.FileIO) -> bool:
    try:
        return os.path.samestat(path.stat(), os.fstat(stream.fileno()))
    except FileNotFoundError:
        return False


def is_reserved(name: str) -> bool:
    """Whether Windows means a device by a file's name."""
    return name.partition(".")[0].strip().lower() in _DEVICES


def ensure_writable(directory: Path) -> None:
    """Make `directory` and try to write in it; `InputError` says why when that fails."""
    with _said_of(directory / "file"):
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass


@contextlib.contextmanager
def _said_of(path: Path, size: int = 0) -> Iterator[None]:
    """Say in our words why a file of `size` bytes cannot be written."""
    folder = str(path.parent)
    folder = folder if len(folder) < _LONGEST_SHOWN else f"{folder[:100]}..."
    if "\0" in str(path):
        raise InputError(f"{path}: cannot be written (a zero byte in the name)")
    try:
        yield
    except OSError as error:
        if error.errno in _NO_ROOM:
            told = f"{reason(error)}; {_bytes(size)} needed"
            if error.errno == errno.ENOSPC:
                told += f", {_room(path)} free"
            again = "make room and give the same command again; what is finished is kept"
            raise StorageError(f"{path}: cannot be written ({told}); {again}") from error
        raise InputError(
            f"output folder {folder}: cannot be written ({reason(error)}); "
            "give a folder that can be made and written with --out"
        ) from error


def _room(path: Path) -> str:
    """Free bytes where a file would be written."""
    try:
        return _bytes(shutil.disk_usage(path.parent).free)
    except OSError:
        return "unknown"


def _bytes(number: int) -> str:
    for unit, name in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if number >= unit:
            return f"{number / unit:.3g} {name}"
    return f"{number} bytes"


def file_digest(path: Path) -> str:
    """Hexadecimal SHA-256 of a file."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
