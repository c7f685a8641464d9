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
        Plain text that says what is drawn and, in numbers taken from the data, what is seen.
    draw : callable
        Makes the figure; to be called within `contactstudy.plot.style.figure_style`.
    """

    name: str
    caption: str
    draw: Callable[[], Figure]
