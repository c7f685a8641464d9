"""The two ways a study can fail: what the user gave, and what the numbers did."""

from collections.abc import Iterable


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


class NumericalError(ContactStudyError):
    """The computation broke down; the message says where (step, position) and why."""
