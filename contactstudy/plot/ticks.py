"""Ticks of axes: plain text beside logarithmic ones, and no label over another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import Formatter, LogFormatterSciNotation, NullFormatter

from contactstudy.plot.text import tick

_GAP = 0.35
"""Between labels at least, in heights of their text."""


class _Powers(LogFormatterSciNotation):
    """Ticks of a logarithmic axis as "2·10⁻³": plain text, for texts of figures are no markup."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        """The text of a tick, "" for one that has none."""
        return tick(x) if super().__call__(x, pos) else ""


class _Fewer(Formatter):
    """Another formatter's texts, but not at some of the places."""

    def __init__(self, inner: Formatter, bare: Sequence[float]) -> None:
        self._inner, self._bare = inner, frozenset(bare)

    def __call__(self, x: float, pos: int | None = None) -> str:
        """The text of a tick."""
        return "" if x in self._bare else self._inner(x, pos)

    def set_locs(self, locs: list[float]) -> None:
        """All places, by which some formatters choose their digits."""
        self._inner.set_locs(locs)


def plain_powers(figure: Figure) -> None:
    """Give all logarithmic axes of a figure ticks without markup."""
    for _, axis in _axes(figure):
        for formatter, replace in (
            (axis.get_major_formatter(), axis.set_major_formatter),
            (axis.get_minor_formatter(), axis.set_minor_formatter),
        ):
            if type(formatter) is LogFormatterSciNotation:
                replace(
                    _Powers(
                        labelOnlyBase=formatter.labelOnlyBase,
                        minor_thresholds=formatter.minor_thresholds,
                    )
                )


def without_overlaps(figure: Figure) -> None:
    """Leave out labels of ticks that would touch others: minor ones, then all but every k-th.

    The figure must be laid out.
    """
    for along, axis in _axes(figure):
        major = _shown(axis.get_majorticklabels(), axis, along)
        minor = _shown(axis.get_minorticklabels(), axis, along)
        if minor and _touch([*major, *minor], along):
            axis.set_minor_formatter(NullFormatter())
        every = next(k for k in range(1, len(major) + 2) if not _touch(major[::k], along))
        if every > 1:
            bare = [t.get_position()[along] for i, t in enumerate(major) if i % every]
            axis.set_major_formatter(_Fewer(axis.get_major_formatter(), bare))


def _axes(figure: Figure) -> Iterator[tuple[int, Axis]]:
    """Each axis, and whether it stands along x (0) or y (1)."""
    for one in figure.axes:
        for axes in (one, *one.child_axes):
            yield 0, axes.xaxis
            yield 1, axes.yaxis


def _shown(labels: Sequence[Text], axis: Axis, along: int) -> list[Text]:
    """The labels that are drawn, in the order of their places."""
    low, high = sorted(axis.get_view_interval())
    inside = [t for t in labels if low <= t.get_position()[along] <= high]
    drawn = [t for t in inside if t.get_visible() and t.get_text()]
    return sorted(drawn, key=lambda t: t.get_position()[along])


def _touch(labels: Sequence[Text], along: int) -> bool:
    """Whether any labels touch, of neighbours along the axis."""
    ordered = sorted(labels, key=lambda t: t.get_position()[along])
    boxes = [t.get_window_extent() for t in ordered]
    gap = 0.0 if along else _GAP * max((box.height for box in boxes), default=0.0)
    return any(a.padded(gap, 0.0).overlaps(b) for a, b in pairwise(boxes))
