"""Where the report finds what it needs in the metrics of a study."""

from collections.abc import Mapping
from typing import Any

from contactstudy.study.results import StudyResults


def of_run(results: StudyResults, name: str) -> dict[str, Any]:
    """Sizes, times and memory of a run; sizes from the run itself where metrics lack them."""
    attrs = results.runs[name].attrs
    known = {key: attrs[key] for key in ("dofs", "steps", "dt") if key in attrs}
    return known | dict(results.metrics.get("runs", {}).get(name, {}))


def between(results: StudyResults, name: str, signal: str) -> Mapping[str, Any] | None:
    """Errors of a run's signal against the reference; None for the reference itself."""
    found = results.metrics.get("comparisons", {}).get(name, {}).get(signal)
    return found if isinstance(found, Mapping) else None
