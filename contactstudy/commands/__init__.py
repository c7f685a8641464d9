"""The commands; each imports what it computes with when it is called."""

from cyclopts import App

from contactstudy.commands.advising import advise
from contactstudy.commands.asking import check, status
from contactstudy.commands.exporting import export
from contactstudy.commands.listing import cache, keys, studies
from contactstudy.commands.running import reproduce, run
from contactstudy.commands.verifying import verify


def _version() -> str:
    """Looking it up takes time."""
    from contactstudy.version import __version__

    return __version__


app = App(
    name="contactstudy",
    help="How wrong the simple wheel-rail contact model is: point against surface contact.",
    version=_version,
    help_format="plaintext",  # Markdown takes as long to load as all the rest
)
for command in (run, check, reproduce, advise, verify, export, status, studies, keys, cache):
    app.command(command)
