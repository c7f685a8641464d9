"""The ways a study can fail: what the user gave, where it is written, what the numbers did."""

import errno
from collections.abc import Iterable, Iterator
from contextlib import contextmanager


class ContactStudyError(Exception):
    """Base of all errors that are reported to the user in one message, without a traceback."""

    exit_status = 1


class InputError(ContactStudyError):
    """The input cannot be used; every problem of one file or call is listed at once.

    Parameters
    ----------
    problems : str or iterable of str
        One sentence a problem: the key or file, the value given, what is allowed and its unit.
    """

    exit_status = 2

    def __init__(self, problems: str | Iterable[str]) -> None:
        self.problems: tuple[str, ...] = (
            (problems,) if isinstance(problems, str) else tuple(problems)
        )
        super().__init__("\n".join(self.problems))


@contextmanager
def gathered(problems: list[str], prefix: str = "") -> Iterator[None]:
    """Enter the problems of an `InputError` into a list, so that others are found as well."""
    try:
        yield
    except InputError as error:
        problems += [f"{prefix}{problem}" for problem in error.problems]


class StorageError(ContactStudyError):
    """A file cannot be written, because the disk, a quota or a limit of its size is reached."""


class NumericalError(ContactStudyError):
    """The computation broke down; the message says where (step, position) and why."""


_REASONS = {
    errno.EACCES: "you may not do that",
    errno.EPERM: "you may not do that",
    errno.EROFS: "the disk is read-only",
    errno.ENOTDIR: "a part of its path is a file, not a folder",
    errno.EEXIST: "a part of its path is a file or a broken link, not a folder",
    errno.EISDIR: "it is a folder",
    errno.ENOTEMPTY: "it is a folder",
    errno.ENOENT: "there is no such folder",
    errno.ENAMETOOLONG: "its name is too long",
    errno.ELOOP: "its links lead to each other",
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "your quota on the disk is used up",
    errno.EFBIG: "it is larger than files may become here, see ulimit -f",
    errno.EIO: "the disk reports an error",
}


def reason(error: BaseException | None) -> str:
    """Why a file could not be opened or written."""
    code = error.errno if isinstance(error, OSError) else None
    if code in _REASONS:
        return _REASONS[code]
    return getattr(error, "strerror", None) or type(error).__name__
