"""What a point run tells of its rail and law."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from contactstudy.contact.laws import (
    ContactLaw,
    HertzSpring,
    LinearSpring,
    PressSpring,
    RigidContact,
)
from contactstudy.contact.patch_laws import FollowingPatch, PatchLaw, WinklerBedding
from contactstudy.track.beam import BeamTrack
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.structure import StructureTrack

if TYPE_CHECKING:
    import xarray as xr


class BeyondPressWarning(UserWarning):
    """A contact force is larger than those of the press that its law comes from."""


def described_rail(track: DiscreteTrack) -> dict[str, object]:
    """Attributes of a run's dataset."""
    if not isinstance(track, BeamTrack | StructureTrack):
        return {"rail": "solid"}
    return {
        "rail": track.theory,
        "elements_per_bay": track.elements_per_bay,
        "local_compliance": int(track.element_compliance),
    }


def described_law(law: ContactLaw | PatchLaw) -> dict[str, object]:
    """Attributes of a run's dataset."""
    match law:
        case LinearSpring(stiffness=stiffness):
            return {"law": "linear", "k_r": stiffness}
        case HertzSpring(stiffness=stiffness):
            return {"law": "hertz", "k_H": stiffness}
        case PressSpring():
            return {"law": "press"}
        case FollowingPatch():
            return described_law(law.law)
        case WinklerBedding():
            return {"law": "bedding"}
        case RigidContact():
            return {"law": "rigid"}
        case _:
            return {"law": "moving force"}


def warn_beyond(law: ContactLaw | PatchLaw, data: xr.Dataset) -> None:
    """Warn if a force is larger than those of the press that the law comes from."""
    plain = law.law if isinstance(law, FollowingPatch) else law
    if isinstance(plain, PressSpring) and (peak := float(data.contact_force.max())) > plain.largest:
        warnings.warn(
            f"the contact force reaches {peak / 1e3:.4g} kN, more than the press was computed for "
            f"({plain.largest / 1e3:.4g} kN); beyond it grows with the 3/2 power of the approach",
            BeyondPressWarning,
            stacklevel=3,
        )
