"""What a figure is before it is drawn."""

from collections.abc import Callable
from dataclasses import dataclass

from matplotlib.figure import Figure


@dataclass(frozen=True)
class Drawing:
    """A figure that these results can fill.

    Attributes
    ----------
    name : str
        File name without ending.
    caption : str
        Plain text that says what is drawn and, in numbers taken from the data, what is seen; these
        are left out where a table beside the figure has them.
    draw : callable
        Makes the figure; to be called within `contactstudy.plot.style.figure_style`.
    found : str
        What is seen, for an abstract, where that is not the caption.
    """

    name: str
    caption: str
    draw: Callable[[], Figure]
    found: str = ""
