"""Which figures a passage has, in the order of its report."""

from contactstudy.figures import (
    bands,
    bridge_picture,
    deck,
    deck_damping,
    histories,
    irregularity,
    ladder,
    measured,
    model,
    passing,
    patch,
    patch_history,
    patch_status,
    press,
    section,
    stiffness,
    stress,
    supports,
    trust,
    vibration,
    wheel_forces,
)
from contactstudy.plot.drawing import Drawing
from contactstudy.study.results import StudyResults

_FAMILIES = (
    model, trust, stiffness, ladder, measured, irregularity, histories, bands, bridge_picture,
    deck, vibration, supports,
    deck_damping, wheel_forces,
    patch, patch_status, stress, patch_history, section, press, passing,
)  # fmt: skip


def drawings(results: StudyResults) -> list[Drawing]:
    """All figures that these results can fill."""
    return [made for family in _FAMILIES for made in family.drawings(results)]


def draws_grid(results: StudyResults) -> bool:
    """Whether there is a map of trust, or curves over the contact stiffness."""
    return trust.trust_map(results) is not None or bool(stiffness.curves(results))
