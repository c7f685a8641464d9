"""Whether the discretisation error of a study's surface contact is known."""

import math
from collections.abc import Mapping
from typing import Any

from contactstudy.plot.text import listing
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.own_error import DEFAULTS, ReferenceError
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.results import StudyResults

COMMAND = "contactstudy verify convergence"
# keys of [solid] that decide the error
_NUMERICS = (
    "section", "mesh_size", "coarse_mesh_size", "cell_length", "interface_modes", "internal_modes",
    "contact_half_length", "contact_half_width", "contact_points", "penalty", "enforcement",
)  # fmt: skip


def reference_error(results: StudyResults) -> tuple[ReferenceError | None, str]:
    """The reference's own error, or why it is not known."""
    run: Mapping[str, Any] = results.config.get("runs", {}).get(results.reference or "", {})
    if run.get("solver") != "surface":
        return None, "the reference is not surface contact"
    known, solid = Solid().resolved(), results.config.get("solid", {})
    changed = [f"solid.{k}" for k in _NUMERICS if k in solid and not _same(solid[k], known[k])]
    if run.get("wheel", "quasi-static") != "quasi-static":
        changed.append("wheel")
    journey = results.config.get("journey", {})
    if float(run.get("time_step") or journey.get("time_step", 0.0)) > Journey.time_step * 1.0001:
        changed.append("journey.time_step")
    if float(journey.get("speed", 0.0)) > Journey.speed * 1.0001:
        changed.append("journey.speed")
    rough = results.config.get("irregularity", {})
    short = rough.get("spectrum") != "paper" or max(rough.get("band", [20.0])) > 20.0001
    defects = {rough.get(key) or "none" for key in ("rail_defect", "wheel_defect")}
    if short or defects != {"none"}:
        changed.append("irregularity")
    if changed:
        return None, f"measured on the default case only, which has another {listing(changed)}"
    return DEFAULTS, ""


def _same(value: Any, default: Any) -> bool:
    if isinstance(default, float) and isinstance(value, int | float):
        return math.isclose(value, default, rel_tol=1e-9)
    return bool(value == default)
