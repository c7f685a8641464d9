"""What a verification case hands back: checks, tables and curves, as plain data."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from contactstudy.plot.curves import Plot

Cell = str | int | float | None
_PER_SI = {
    "mm": 1e3, "um": 1e6, "µm": 1e6, "mm^2": 1e6, "mm²": 1e6, "kN": 1e-3, "MPa": 1e-6
}  # fmt: skip


@dataclass(frozen=True)
class Check:
    """A computed value beside its reference.

    Attributes
    ----------
    quantity : str
        What is compared and where, e.g. "peak pressure at 80 kN".
    computed, reference : float
        In `unit`.
    unit : str
        "" for a pure number.
    source : str
        Where the reference is from: closed form, publication, program and version.
    band : float or None
        Relative band that the difference must keep; None: reported, not judged.
    sense : {"equal", "at_most", "at_least"}
        With "at_most" and "at_least" the reference is a limit, exceeded by `band` at most.
    scale : float or None
        What the difference is divided by, in `unit`; None: the reference. Give it where the
        reference may be zero, as a position has the patch's semi-axis.
    """

    quantity: str
    computed: float
    reference: float
    unit: str
    source: str
    band: float | None
    sense: Literal["equal", "at_most", "at_least"] = "equal"
    scale: float | None = None

    @property
    def difference(self) -> float:
        """Computed less reference, in `unit`."""
        return self.computed - self.reference

    @property
    def error(self) -> float:
        """Relative difference, signed; nan when nothing can be divided by."""
        scale = abs(self.reference if self.scale is None else self.scale)
        return self.difference / scale if scale > 0.0 else math.nan

    @property
    def passed(self) -> bool | None:
        """Whether the band is kept; None when there is none. What is not finite never passes."""
        if self.band is None:
            return None
        if self.difference == 0.0:
            return True
        error = self.error
        if self.sense == "at_most":
            return bool(error <= self.band)
        if self.sense == "at_least":
            return bool(error >= -self.band)
        return bool(abs(error) <= self.band)


@dataclass(frozen=True)
class ResultTable:
    """Rows of texts and numbers; numbers are shown with four digits.

    Attributes
    ----------
    caption : str
    header : tuple of str
        Column headings with units, e.g. "load (kN)".
    rows : tuple of tuple
        As many cells as the header; None is shown as a dash.
    """

    caption: str
    header: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def __post_init__(self) -> None:
        wrong = [i for i, row in enumerate(self.rows) if len(row) != len(self.header)]
        if wrong:
            raise ValueError(f"{self.caption}: rows {wrong} do not have {len(self.header)} cells")


@dataclass(frozen=True)
class CaseResult:
    """What one named case found.

    Attributes
    ----------
    name : str
        As listed in `contactstudy.verification.cases`.
    title : str
    method : str
        What is compared with what, and how; paragraphs are parted by an empty line.
    """

    name: str
    title: str
    method: str
    checks: tuple[Check, ...]
    tables: tuple[ResultTable, ...] = ()
    figures: tuple[Plot, ...] = ()

    @property
    def failed(self) -> tuple[Check, ...]:
        """Checks that leave their band."""
        return tuple(check for check in self.checks if check.passed is False)


def check_shown(
    quantity: str,
    computed: float,
    reference: float,
    unit: str,
    source: str,
    band: float | None,
    scale: float | None = None,
) -> Check:
    """Check of SI values, which it shows in the handy `unit`."""
    factor = _PER_SI[unit]
    scale = None if scale is None else factor * scale
    return Check(quantity, factor * computed, factor * reference, unit, source, band, scale=scale)


def check_at_most(quantity: str, computed: float, limit: float, unit: str, source: str) -> Check:
    """Check against a limit that must not be exceeded at all."""
    return Check(quantity, computed, limit, unit, source, 0.0, "at_most")


def check_lines(checks: Sequence[Check]) -> str:
    """Lines with computed, reference, difference and band, for a terminal."""
    lines = []
    for c in checks:
        verdict = {True: "ok", False: "FAILS", None: "reported"}[c.passed]
        limit = {"equal": "", "at_most": "at most ", "at_least": "at least "}[c.sense]
        band = "" if c.band is None else f", band {100 * c.band:g} %"
        lines.append(
            f"{c.quantity}: {c.computed:.5g} {c.unit} (reference {limit}{c.reference:.5g}, "
            f"{c.source}): {100 * c.error:+.3g} %{band}: {verdict}"
        )
    return "\n".join(lines)
