"""Files that are either whole or not there: the only way anything of the package is written."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import platform
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from contactstudy.exceptions import InputError

#: Marks a temporary file as ours.
_UNFINISHED = ".unfinished-"
_ABANDONED = 3600.0  # s


@contextlib.contextmanager
def writing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path`; rename it to `path` when the block succeeds.

    Its directory is made when absent; `InputError` when it cannot be made or written.
    """
    with _said_of(path.parent):
        path.parent.mkdir(parents=True, exist_ok=True)
        prefix = f"{_UNFINISHED}{_node()}-{os.getpid()}-"
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=prefix, suffix=path.suffix)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)  # mkstemp makes files that only their owner can read
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def remove_unfinished(directory: Path) -> None:
    """Remove what writers left that were killed.

    Of writers that may live, as those on other machines, what is an hour old.
    """
    for path in directory.glob(f"{_UNFINISHED}*"):
        with contextlib.suppress(FileNotFoundError):  # its writer has ended meanwhile
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
def alone(path: Path) -> Iterator[None]:
    """Meanwhile no other process makes `path`; one that is killed gives way at once.

    Where files cannot be locked, others may do the same work at the same time.
    """
    lock = path.with_name(f"{_UNFINISHED}{path.stem}.lock")
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(ImportError, OSError):
            import fcntl

            lock.parent.mkdir(parents=True, exist_ok=True)
            stream = stack.enter_context(lock.open("w"))
            fcntl.flock(stream, fcntl.LOCK_EX)
            stack.callback(lock.unlink, missing_ok=True)
        yield


def ensure_writable(directory: Path) -> None:
    """Make `directory` and try to write in it; `InputError` says why when that fails."""
    with _said_of(directory):
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass


@contextlib.contextmanager
def _said_of(directory: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"output folder {directory}: cannot be written ({reason}); "
            "give a folder that can be made and written with --out"
        ) from error


def file_digest(path: Path) -> str:
    """Hexadecimal SHA-256 of a file."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
