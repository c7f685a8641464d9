"""The commands; each imports what it computes with when it is called."""

from cyclopts import App

from contactstudy.commands.advising import advise, verify_advice
from contactstudy.commands.asking import check, status
from contactstudy.commands.completing import completion
from contactstudy.commands.exporting import export
from contactstudy.commands.listing import cache, keys, studies, vehicles
from contactstudy.commands.looking import diff, plot
from contactstudy.commands.running import reproduce, run
from contactstudy.commands.starting import new
from contactstudy.commands.verifying import verify


def _version() -> str:
    """Looking it up takes time."""
    from contactstudy.version import __version__

    return __version__


app = App(
    name="contactstudy",
    help="How wrong the simple wheel-rail contact model is: point against surface contact.",
    version=_version,
    help_epilogue=(
        "Exit status: 0 done; 1 a run broke down, a check fails, results differ, or there is no "
        "room to write; 2 wrong input, or a file or folder that cannot be used; 130 interrupted; "
        "143 terminated."
    ),
    help_format="plaintext",  # Markdown takes as long to load as all the rest
)
_COMMANDS = (
    new,
    check,
    run,
    reproduce,
    advise,
    plot,
    diff,
    status,
    verify,
    verify_advice,
    export,
    studies,
    vehicles,
    keys,
    cache,
    completion,
)
for command in _COMMANDS:
    app.command(command)
