"""Tables of runs held against a measured record."""

from contactstudy.figures.measured import GROUP, fitted, spread
from contactstudy.plot.text import label, listing, number
from contactstudy.report.blocks import Block, table, text
from contactstudy.study.kinds.passage.held_against import reversed_sentences
from contactstudy.study.results import StudyResults

_COLUMNS = [
    "Run", "Channel", "Correlation", "Peak ratio", "Error (%)", "Magnitude", "Phase", "Timing (ms)",
]  # fmt: skip
EXPLAINED = (
    "Peak ratio: largest computed over largest measured value, of the measured peak's sign. Error: "
    "relative L2 difference. Magnitude and phase: Sprague and Geers. Timing: by how much later the "
    "computed channel comes once the record is shifted."
)


def measured_sentences(results: StudyResults) -> list[str]:
    """For the abstract: how well each run agrees, and what was fitted."""
    told = []
    for run, one in fitted(results).items():
        channels = one["channels"].values()
        correlations = [c["correlation"] for c in channels]
        errors = [100 * c["normalised_error"] for c in channels]
        told.append(
            f"{label(run)} has a correlation of {spread(correlations)} and a normalised error of "
            f"{spread(errors, 2)} %"
        )
    if not told:
        return []
    known = "one scale and " if results.config.get(GROUP, {}).get("scale") == "fitted" else ""
    return [
        f"Held against the measured record, with {known}one shift of its clock for all channels, "
        f"{listing(told)}."
    ]


def measured_tables(results: StudyResults) -> list[Block]:
    """How each channel of each run agrees, and which runs could not be laid over the record."""
    rows = [
        [
            label(run),
            channel,
            number(one["correlation"], 4),
            number(one["peak_ratio"], 3),
            number(100 * one["normalised_error"], 3),
            number(one["sprague_geers"]["M"], 2),
            number(one["sprague_geers"]["P"], 2),
            number(1e3 * one["timing"], 2),
        ]
        for run, found in fitted(results).items()
        for channel, one in found["channels"].items()
    ]
    blocks = [table(_COLUMNS, rows, "Computed against measured.", 2, EXPLAINED)] if rows else []
    failed = {
        run: one["failure"]
        for run, one in results.metrics.get(GROUP, {}).get("runs", {}).items()
        if "failure" in one
    }
    told = [f"{label(run)}: {why}." for run, why in failed.items()]
    return blocks + [text(one) for one in reversed_sentences(fitted(results)) + told]
