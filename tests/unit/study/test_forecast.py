"""Sizes that `check` foretells against those of the discretised track."""

import pytest

from contactstudy.solids.cell import condense
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.forecast import solid_dofs
from contactstudy.study.loading import load_study
from contactstudy.track.solid import SolidTrack

COARSE = (
    "solid.mesh_size=0.006",
    "solid.interface_modes=6",
    "solid.internal_modes=2",
    "track.length=3",
    "journey.from=1",
    "journey.to=2",
    "journey.fade_in=0",
    "journey.stations=[]",
    "solid.pressure_at=[]",
)


@pytest.fixture(scope="module")
def cell():
    return condense(build.recipe(load_study("smooth_rail", COARSE)))


@pytest.mark.parametrize("ends", ["clamped", "pinned", "free"])
@pytest.mark.parametrize("layer", ["ballast", "slab"])
def test_dofs_of_the_solid_track(cell, ends, layer):
    study = load_study("smooth_rail", (*COARSE, f"track.ends={ends}", f"track.layer={layer}"))
    track = build.track(study)
    assert solid_dofs(study, track) == SolidTrack(track, cell).n_dofs
