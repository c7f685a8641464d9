"""The command line: what it does with any command, and with what goes wrong in it.

Exit status 0, 1 (broke down, or a check fails), 2 (input), 130 (interrupted).
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from collections.abc import Sequence

from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.process import ONE_THREAD
from contactstudy.texts import visible


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (of `arguments`, else ``sys.argv``); returns the exit status."""
    # before anything loads a BLAS: bytes, and small problems' speed, depend on its threads
    os.environ.update(ONE_THREAD)
    os.environ["MPLBACKEND"] = "agg"  # no notebook's, whatever the environment says
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a console without our characters shows "?"
            stream.reconfigure(errors="replace")
    tokens = list(sys.argv[1:] if arguments is None else arguments)
    if (
        signal.getsignal(signal.SIGINT) is signal.SIG_IGN
        and threading.current_thread() is threading.main_thread()
    ):
        # a shell starts background jobs of a script this way; an interrupt that is sent to a
        # long computation by name shall end it all the same
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        _call(tokens)
    except ContactStudyError as error:
        _complain(str(error))
        return error.exit_status
    except KeyboardInterrupt:
        _complain("interrupted; finished runs are kept, the same command goes on from there")
        return 130
    except BrokenPipeError:  # output piped into a program that has stopped reading
        sys.stderr.close()
        return 141
    return 0


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
    lines = visible(text).split("\n")
    print(
        f"contactstudy: {lines[0]}", *(f"  {line}" for line in lines[1:]), sep="\n", file=sys.stderr
    )


if __name__ == "__main__":
    sys.exit(main())
