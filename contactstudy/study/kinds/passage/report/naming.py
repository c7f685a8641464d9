"""How runs are called in sentences, and which of them is our reading of the paper's scheme."""

import math

from contactstudy.plot.text import label
from contactstudy.study.kinds.passage.report.tables import describe
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.results import StudyResults

OUR_K_R = 1e11
"""N/m, our reading of the paper's "considerably large value"."""
OUR_READING = "our reading of the paper's scheme"
# what the paper leaves open besides k_r
_OPEN = {"solver", "elements_per_bay", "time_step", "k_r", "wheel"}


def papers_scheme(results: StudyResults) -> str | None:
    """Name of the run that is our reading of the paper's scheme; None if there is none.

    Linear, on an Euler beam, with our large constant k_r, and nothing else that the paper does not
    have.
    """
    wanted = PointRun().resolved()
    for name, run in results.config.get("runs", {}).items():
        k_r = run.get("k_r")
        ours = isinstance(k_r, int | float) and math.isclose(k_r, OUR_K_R, rel_tol=1e-9)
        others = {key: value for key, value in run.items() if key not in _OPEN}
        plain = all(wanted.get(key, value) == value for key, value in others.items())
        if run.get("solver") == "point" and ours and plain and run.get("wheel") != "modal":
            return str(name)
    return None


def model(results: StudyResults, name: str) -> str:
    """Name of a run with its rail and contact."""
    rail, contact = describe(results, name)
    return f"“{label(name)}” (contact: {contact}; rail: {rail})"
