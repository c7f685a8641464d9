"""The command line: what it does with any command, and with what goes wrong in it.

Exit status 0, 1 (broke down, a check fails, or no room to write), 2 (input), 130 (interrupted), 141
(nobody reads what is printed), 143 (terminated).
"""

from __future__ import annotations

import contextlib
import errno
import io
import os
import re
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from types import FrameType

from contactstudy.exceptions import ContactStudyError, InputError, reason
from contactstudy.process import ONE_THREAD
from contactstudy.texts import visible

_ENDING = (signal.SIGINT, signal.SIGTERM)
_AGAIN = 0.2  # s until an interrupt that nobody has dealt with comes again
_stopped: list[int] = []


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (of `arguments`, else ``sys.argv``); returns the exit status."""
    # before anything loads a BLAS: bytes, and small problems' speed, depend on its threads
    os.environ.update(ONE_THREAD)
    os.environ["MPLBACKEND"] = "agg"  # no notebook's, whatever the environment says
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a console without our characters shows "?"
            stream.reconfigure(errors="replace")
    tokens = list(sys.argv[1:] if arguments is None else arguments)
    with _interrupts():
        status = _status(tokens)
    if arguments is None and status in (130, 143):  # it is not interrupted in ending
        for number in _ENDING:
            signal.signal(number, signal.SIG_IGN)
    return status


def _status(tokens: Sequence[str]) -> int:
    """Call a command; its exit status, with a message where that is not 0."""
    try:
        _call(tokens)
        if sys.stdout is not None:
            sys.stdout.flush()  # who does not read is found out here, not at the exit
        _no_more()
    except ContactStudyError as error:
        _complain(str(error))
        return error.exit_status
    except KeyboardInterrupt as stop:
        _no_more()
        # CPython ends by SIGINT where the last text that it compiled and ran, as dataclasses do,
        # was interrupted, though it is caught here; a text that runs to its end puts that right
        exec("")
        how = "terminated" if stop.args == (signal.SIGTERM,) else "interrupted"
        _complain(f"{how}; finished runs are kept, the same command goes on from there")
        return 143 if how == "terminated" else 130
    except BrokenPipeError:  # output piped into a program that has stopped reading
        _print_no_more()
        return 141
    except MemoryError:
        _complain("out of memory; finished runs are kept, the same command goes on from there")
        return 1
    except OSError as error:
        _print_no_more()
        _complain(f"{error.filename or 'standard output'}: {reason(error)}")
        return 2 if error.errno == errno.ENAMETOOLONG else 1
    return 0


def _print_no_more() -> None:
    """What is left to print goes nowhere, so that Python does not stumble over it at the exit."""
    with contextlib.suppress(OSError, AttributeError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextlib.contextmanager
def _interrupts() -> Iterator[None]:
    """Meanwhile Ctrl-C and SIGTERM end a command.

    A shell starts background jobs of a script with interrupts ignored; one that is sent to a long
    computation by name shall end it all the same.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, _interrupt) for number in _ENDING}
    yield
    _no_more()
    for number, handler in before.items():
        signal.signal(number, handler or signal.SIG_DFL)


def _interrupt(number: int, frame: FrameType | None) -> None:
    # libraries catch whatever is raised while they import what they can do without
    _stopped.append(number)
    if os.name == "posix":
        signal.signal(signal.SIGALRM, _again)
        signal.setitimer(signal.ITIMER_REAL, _AGAIN, _AGAIN)
    raise KeyboardInterrupt(number)


def _again(alarm: int, frame: FrameType | None) -> None:
    """The same interrupt once more, but not in what it has set off."""
    if _stopped and not isinstance(sys.exception(), KeyboardInterrupt):
        raise KeyboardInterrupt(_stopped[-1])


def _no_more() -> None:
    """An interrupt that has come does not come again."""
    if _stopped and os.name == "posix":
        signal.setitimer(signal.ITIMER_REAL, 0.0)
    _stopped.clear()


def _call(tokens: Sequence[str]) -> None:
    # imported here, so that Ctrl-C meanwhile is ours to answer
    from cyclopts import CycloptsError

    from contactstudy.commands import app

    try:
        # parsed and called apart for the same reason
        command, bound, _ = app.parse_args(tokens, exit_on_error=False, print_error=False)
    except CycloptsError as error:
        raise InputError(f"{error}\nTry 'contactstudy --help'.") from error
    command(*bound.args, **bound.kwargs)


def _complain(text: str) -> None:
    short = re.sub(r"\S{300,}", lambda word: f"{word[0][:100]}...", text)
    lines = visible(short).split("\n")
    print(
        f"contactstudy: {lines[0]}", *(f"  {line}" for line in lines[1:]), sep="\n", file=sys.stderr
    )


if __name__ == "__main__":
    sys.exit(main())
