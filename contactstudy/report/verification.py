"""The verification document as a PDF: what each named case found."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from contactstudy.files import write_file
from contactstudy.plot.draw import draw
from contactstudy.plot.style import figure_style, save
from contactstudy.plot.text import exact
from contactstudy.report.blocks import Block, bullets, figure, table, text
from contactstudy.report.quantity import percent, pretty_unit, rounded
from contactstudy.report.typesetting import typeset
from contactstudy.verification.check import Cell, Check, ResultTable
from contactstudy.verification.outcome import CaseOutcome

PDF_FILE = "verification.pdf"
_WORDS = {True: "kept", False: "LEFT", None: "none"}
_LIMITS = {"equal": "", "at_most": "at most ", "at_least": "at least "}


def write_verification(
    outcomes: Sequence[CaseOutcome], about: dict[str, Any], out_dir: Path
) -> Path:
    """Set out_dir/verification.pdf; its figures go into out_dir/figures as well.

    `about` are versions and hash, see `contactstudy.verification.runner.about`.
    """
    with figure_style():
        for outcome in outcomes:
            for k, plot in enumerate(outcome.result.figures if outcome.result else ()):
                save(draw(plot), out_dir / "figures", _figure(outcome, k))
    target = out_dir / PDF_FILE
    write_file(target, typeset(("sections.typ",), document(outcomes, about), out_dir))
    return target


def document(outcomes: Sequence[CaseOutcome], about: dict[str, Any]) -> dict[str, Any]:
    """Everything that the template inserts."""
    versions = about["versions"]
    return {
        "title": "Verification of contactstudy",
        "subtitle": f"contactstudy {versions['contactstudy']}",
        "name": "contactstudy verify",
        "summary": _summary(outcomes),
        "cases": [
            {"title": f"{o.result.title} ({o.name})", "blocks": _case(o)}
            for o in outcomes
            if o.result is not None
        ],
        "provenance": [
            bullets(
                [
                    f"Versions: {', '.join(f'{k} {v}' for k, v in versions.items())}.",
                    f"Hash of the program's code: {about['code']}.",
                    "Each case is run and printed by the command “contactstudy verify NAME”, and "
                    "asserted by the program's tests.",
                    "The same program gives the same bytes of this document.",
                ]
            )
        ],
    }


def _summary(outcomes: Sequence[CaseOutcome]) -> list[Block]:
    checks = [c for o in outcomes if o.result for c in o.result.checks]
    banded = [c for c in checks if c.passed is not None]
    kept = sum(c.passed is True for c in banded)
    plural = "s" if len(outcomes) > 1 else ""
    lines = (
        f"{len(outcomes)} named case{plural}, {len(checks)} comparisons with a reference; "
        f"{len(banded)} have a band, and {kept} of these are within it. A band limits the "
        "difference relative to the reference (or to the scale that the case names). What has no "
        "band is reported."
    )
    rows = []
    for o in outcomes:
        found = o.result.checks if o.result else ()
        own = [c for c in found if c.passed is not None]
        rows.append(
            [
                o.name,
                o.result.title if o.result else o.reason,
                o.status,
                f"{sum(c.passed is True for c in own)} of {len(own)}" if o.result else "–",
                percent(_largest_share(own), 2) if own else "–",
            ]
        )
    columns = ["Case", "What", "CaseStatus", "Kept", "Largest share of a band (%)"]
    made = table(columns, rows, "Named cases.", 3)
    made["columns"][1]["wide"] = True
    return [text(lines), made]


def _largest_share(checks: Sequence[Check]) -> float:
    """Largest difference relative to its band; limits and exact checks have no share."""
    shares = [abs(c.error) / c.band for c in checks if c.band and c.sense == "equal"]
    return max(shares, default=float("nan"))


def _case(outcome: CaseOutcome) -> list[Block]:
    result = outcome.result
    assert result is not None
    blocks = [text(" ".join(p.split())) for p in result.method.split("\n\n")]
    blocks.append(_checks(result.checks))
    blocks += [_table(t) for t in result.tables]
    blocks += [figure(_figure(outcome, k), p.caption) for k, p in enumerate(result.figures)]
    return blocks


def _figure(outcome: CaseOutcome, index: int) -> str:
    return f"{outcome.name}_{index + 1}"


def _checks(checks: Sequence[Check]) -> Block:
    sources = list(dict.fromkeys(c.source for c in checks))
    columns = ["Quantity", "Computed", "Reference", "Unit", "Difference (%)", "Band (%)", "Band is"]
    rows = []
    for c in checks:
        row = [c.quantity, rounded(c.computed, 5), _LIMITS[c.sense] + rounded(c.reference, 5)]
        row += [_unit(c.unit), _difference(c.error), _band(c), _WORDS[c.passed]]
        rows.append(row if len(sources) == 1 else [*row, str(sources.index(c.source) + 1)])
    if len(sources) == 1:
        note = f"Reference: {sources[0]}."
    else:
        columns.append("Source")
        note = "Sources: " + "; ".join(f"({i + 1}) {s}" for i, s in enumerate(sources)) + "."
    made = table(columns, rows, "Reference beside computed.", 1, note)
    made["columns"][0]["wide"] = True
    if max(len(c.quantity) for c in checks) > 36:  # fewer of them then take two lines
        made["size"] = 8
    return made


def _unit(unit: str) -> str:
    return pretty_unit(unit.replace("um", "µm")) or "–"


def _difference(error: float) -> str:
    """In per cent; what is below 1e-5 is rounding, whose digits mean nothing."""
    return "below 0.001" if 0.0 < abs(error) < 1e-5 else percent(error, 2)


def _band(check: Check) -> str:
    if check.band is None:
        return "–"
    return "limit" if check.band == 0.0 else exact(100 * check.band, 3)


def _table(content: ResultTable) -> Block:
    rows = [[_cell(cell) for cell in row] for row in content.rows]
    made = table(list(content.header), rows, content.caption, 0)
    for i, column in enumerate(made["columns"]):
        if all(isinstance(row[i], str) for row in content.rows):
            column["align"] = "left"
    if len(content.header) > 7:
        made["size"] = 8
    return made


def _cell(cell: Cell) -> str:
    if isinstance(cell, str):
        return cell
    if isinstance(cell, float):
        return exact(cell, 4) if math.isfinite(cell) else "–"
    return "–" if cell is None else str(cell)
