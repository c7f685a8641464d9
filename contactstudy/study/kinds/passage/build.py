"""From the tables of a study to the objects that the solvers take."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.profiles.named import OWN
from contactstudy.profiles.wheel_file import wheel_dimensions
from contactstudy.solids.bodies import modes_body, rail_body, wheel_body
from contactstudy.solids.cache import cached
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, rigid_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, WheelModes
from contactstudy.solids.wheel_recipe import FAR_STEP, FAR_STEP_OF_MODES
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.on_bridge import planar_on, vehicle_on
from contactstudy.study.kinds.passage.placing import contact_zone, geometry, meshed_rail
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.track.bay import BayRecipe, corrected_beam
from contactstudy.track.beam import BeamTrack
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import Vehicle


def recipe(study: Study) -> CellRecipe:
    """Recipe of the solid rail's cell; beams take their section from the same mesh."""
    rail, solid = study.track.rail, study.solid
    low, high = contact_zone(study).rail
    return CellRecipe(
        profile=meshed_rail(study),
        size=solid.mesh_size,
        length=solid.cell_length,
        coarse=solid.coarse_mesh_size,
        contact_half_width=0.5 * (high - low),
        interface_modes=solid.interface_modes,
        internal_modes=solid.internal_modes,
        contact_centre=0.5 * (low + high),
        symmetric=solid.half,
        youngs_modulus=rail.youngs_modulus,
        poisson_ratio=rail.poisson_ratio,
        density=rail.density,
    )


def wheel_recipe(study: Study) -> WheelRecipe:
    """Recipe of the meshed wheel: same steel as the rail."""
    rail, solid = study.track.rail, study.solid
    return WheelRecipe(
        profile="cylinder" if solid.half else study.wheelset.wheel_profile,
        profile_ways=OWN if solid.half else study.wheelset.wheel_ways,
        symmetric=solid.half,
        contact_centre=contact_zone(study).wheel,
        rail_profile=meshed_rail(study),
        dimensions=wheel_dimensions(solid.wheel_section).with_radius(study.vehicle.wheel_radius),
        size=solid.mesh_size,
        contact_half_length=solid.contact_half_length,
        contact_half_width=solid.contact_half_width,
        youngs_modulus=rail.youngs_modulus,
        poisson_ratio=rail.poisson_ratio,
        density=rail.density,
        far_step=FAR_STEP_OF_MODES if study.has_wheel_modes else FAR_STEP,
    )


def track(study: Study) -> Track:
    """The track of all runs: its rail has the integrals of the mesh that the solid uses."""
    if study.track.rail.profile_name is None:
        return study.track
    return replace(study.track, rail=solid_rail(recipe(study)))


def solid_track(study: Study, described: Track) -> SolidTrack:
    """The track on its meshed rail, whose cell is condensed or taken from the cache."""
    return SolidTrack(described, cached(rail_body(recipe(study))))


def point_track(study: Study, table: PointRun, described: Track) -> DiscreteTrack:
    """The track of a point run: on a beam, or on its meshed rail."""
    if table.rail == "solid":
        return solid_track(study, described)
    if described.structure is not None:
        planar = planar_on(described, vehicle(study))
        return StructureTrack(described, table.rail, table.elements_per_bay, planar)
    if table.bay_compliance:
        return _corrected(bay_recipe(study, table, described))
    return _beam(
        described,
        table.rail,
        table.elements_per_bay,
        table.local_compliance,
        table.direction,
    )


# Runs of a batch that have equal beams share one, with its matrices.
_beam, _corrected = lru_cache(maxsize=16)(BeamTrack), lru_cache(maxsize=16)(corrected_beam)


def bay_recipe(study: Study, table: PointRun, described: Track) -> BayRecipe:
    """Recipe of what a point run's beam lacks over a bay."""
    assert table.rail != "solid"
    return BayRecipe(described, table.rail, table.elements_per_bay, recipe(study))


def wheel(study: Study, run: str | None = None) -> WheelFlexibility:
    """The meshed wheel of a run or of the study, condensed or taken from the cache."""
    made = wheel_recipe(study)
    if (study.wheel(run) if run else study.solid.wheel) == "rigid":
        return rigid_wheel(made)
    return cached(wheel_body(made))


def surface_contact(study: Study, run: str | None = None) -> SurfaceContact:
    """The wheel of a run, or of the study without modes, in contact with the rail."""
    solid = study.solid
    return SurfaceContact(
        wheel(study, run),
        geometry(study),
        modes(study, run) if run else None,
        wheel_damping=solid.wheel_damping,
        penalty=solid.penalty,
        quadrature=solid.contact_points,
        tolerance=solid.tolerance,
    )


def modes_recipe(study: Study) -> ModesRecipe:
    """Recipe of the wheel's elastic modes."""
    return ModesRecipe(wheel_recipe(study), study.solid.wheel_frequency)


def modes(study: Study, run: str) -> WheelModes | None:
    """The elastic modes of a run's wheel, computed or taken from the cache; None without."""
    if study.wheel(run) != "modal":
        return None
    return cached(modes_body(modes_recipe(study)))


def vehicle(study: Study) -> Vehicle:
    """The vehicle on one rail, or on both of a bridge."""
    return vehicle_on(study.track, study.vehicle)


def journey(study: Study, run: str) -> Journey:
    """The journey with the time step of a run, to where it travels."""
    table = study.runs[run]
    travel = table.travel if isinstance(table, PointRun) else "forward"
    return replace(study.journey, time_step=study.time_step(run), travel=travel)


def frames_at(study: Study) -> tuple[float, ...]:
    """Positions of the wheel in m at which the frames of an animation are kept."""
    table = study.solid
    low, high = table.animation_span or (study.journey.start, study.journey.end)
    return tuple(np.linspace(low, high, table.animation_frames).tolist())
