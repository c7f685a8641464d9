"""The contact of a point run: its law, what it makes of the irregularity, its wheel's modes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from contactstudy.contact.filters import ContactFilter, PatchMean, Trajectory
from contactstudy.contact.laws import (
    ContactLaw,
    HertzSpring,
    LinearSpring,
    MovingForce,
    PressSpring,
    RigidContact,
)
from contactstudy.contact.patch_laws import FollowingPatch, PatchLaw, WinklerBedding
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.contact.press_table import PressTable
from contactstudy.given_files import content_digest
from contactstudy.halfspace.hertz import HertzContact, contact_modulus, hertz_contact
from contactstudy.profiles.wheel_file import named_file_digest
from contactstudy.solids.bodies import modes_body, rail_body, wheel_body
from contactstudy.solids.cache import CachedBody, cached
from contactstudy.solids.wheel_recipe import LARGEST_ZONE
from contactstudy.solvers.at_rest import geometry_table
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.scan import PATHS as SCAN_PATHS
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.wheelset import PATHS as WHEELSET_PATHS
from contactstudy.study.kinds.passage.zone import on_large_enough
from contactstudy.track.bay import bay_body
from contactstudy.track.rail import GivenRail, TabulatedRail
from contactstudy.validation import multiple


@dataclass(frozen=True)
class PressRecipe:
    """Bodies that are pressed: all that decides them, as plain data, and a run that has them."""

    plain: Any
    study: Study = field(repr=False)
    run: str = field(repr=False)


def press_table(study: Study, run: str) -> PressTable:
    """The press of a point run's bodies, but for what modes of its wheel give way."""
    table, wheel = cached(_press_body(study, run)), point_wheel(study, run)
    return table if wheel is None else table.without(wheel.give)


def bodies(study: Study, run: str) -> list[CachedBody[Any]]:
    """The condensed bodies that a run needs, and last what is made of them."""
    needed = list[CachedBody[Any]]()
    if study.meshes_rail(run):
        needed.append(rail_body(build.recipe(study)))
    if study.meshes_wheel(run):
        needed.append(wheel_body(build.wheel_recipe(study)))
    if study.needs_wheel_modes(run):
        needed.append(modes_body(build.modes_recipe(study)))
    table = study.runs[run]
    if isinstance(table, PointRun) and table.bay_compliance:
        needed.append(bay_body(build.bay_recipe(study, table, build.track(study))))
    if study.presses(run):
        needed.append(_press_body(study, run))
    return needed


def _press_body(study: Study, run: str) -> CachedBody[PressTable]:
    return CachedBody("press", PressRecipe(_plain(study, run), study, run), pressed, PressTable)


def pressed(recipe: PressRecipe) -> PressTable:
    """Press the bodies of a point run in the middle of a bay."""

    def compute(study: Study) -> PressTable:
        track = build.solid_track(study, build.track(study))
        contact = build.surface_contact(study, recipe.run)
        table = geometry_table(track, contact, study.vehicle.static_load)
        return replace(table, zone=np.array([getattr(study.solid, key) for key in LARGEST_ZONE]))

    return replace(on_large_enough(recipe.study, compute), recipe=recipe)


def _plain(study: Study, run: str) -> list[Any]:
    """All that decides the press of a run: recipes of the bodies, track, position, enforcement."""
    solid = study.solid
    files = [getattr(study.wheelset, key) for key in WHEELSET_PATHS]
    scans = [getattr(study.scan, key) for key in SCAN_PATHS]
    placed = (
        ()
        if solid.half
        else (
            {k: v for k, v in study.wheelset.resolved().items() if k not in WHEELSET_PATHS},
            [named_file_digest(name) or name for name in files],
            {k: v for k, v in study.scan.resolved().items() if k not in SCAN_PATHS},
            [content_digest(name) if name else "" for name in scans],
        )
    )
    return [
        repr(build.track(study)),
        repr(build.recipe(study)),
        repr(build.wheel_recipe(study)),
        [study.wheel(run) == "rigid", solid.contact_points, solid.penalty, solid.tolerance],
        study.vehicle.static_load,
        *placed,
    ]


def hertz(study: Study) -> HertzContact:
    """Hertz's contact of the study's wheel and rail under the static wheel load."""
    rail, load = study.track.rail, study.vehicle.static_load
    modulus = contact_modulus(rail.youngs_modulus, rail.poisson_ratio)
    if study.solid.half and isinstance(rail, GivenRail | TabulatedRail):
        return hertz_contact(load, modulus, study.vehicle.wheel_radius, rail.crown_radius)
    return hertz_contact(load, modulus, *geometry(study).relative_radii())


def contact_law(study: Study, run: str) -> ContactLaw | PatchLaw:
    """The contact law of a point run."""
    table, load = _point(study, run), study.vehicle.static_load
    if table.law == "moving_force":
        return MovingForce()
    if table.contact_filter == "bedding":
        approach = HertzSpring(_hertz_constant(study, run)).approach_at(load)
        return WinklerBedding(hertz(study).semi_axis_x, approach, load)
    if table.law != "linear":
        return _nonlinear(study, run)
    if isinstance(table.k_r, float):
        return LinearSpring(table.k_r)
    if table.k_r == "rigid":
        return RigidContact()
    factor, name = multiple(table.k_r)
    if study.presses(run) and not name.startswith("hertz"):
        press = press_table(study, run)
        return LinearSpring(factor * float(press.secant if name == "secant" else press.tangent))
    closed = hertz(study)
    secant = name.endswith("secant")
    return LinearSpring(factor * (closed.secant_stiffness if secant else closed.tangent_stiffness))


def _nonlinear(study: Study, run: str) -> HertzSpring | PressSpring | FollowingPatch:
    """Hertz's law or the press, of the mean over the patch at the force of the moment if wanted."""
    table = _point(study, run)
    law: HertzSpring | PressSpring
    if table.law == "hertz":
        law = HertzSpring(_hertz_constant(study, run))
    else:
        press = press_table(study, run)
        law = PressSpring(press.approach, press.force)
    if table.contact_filter != "patch" or table.patch_filter == "fixed":
        return law
    if table.weight_of_press:
        return FollowingPatch.of_press(law, press_table(study, run))
    closed = hertz(study)
    return FollowingPatch.on_ellipse(law, closed.semi_axis_x, law.approach_at(closed.load))


def _hertz_constant(study: Study, run: str) -> float:
    """k_H [N/m^1.5]: of the closed form, or with the press's tangent at the static load."""
    if _point(study, run).hertz_constant == "closed_form":
        return hertz(study).stiffness
    # k_t = 3/2 k_H d^(1/2) and F = k_H d^(3/2):  k_H = (2/3 k_t)^(3/2) F^(-1/2)
    tangent, load = float(press_table(study, run).tangent), study.vehicle.static_load
    return float((2 / 3 * tangent) ** 1.5 / load**0.5)


def contact_filter(study: Study, run: str) -> ContactFilter | None:
    """What the contact of a point run makes of the irregularity, unless its law does that."""
    table = _point(study, run)
    if table.contact_filter == "trajectory":
        return Trajectory(study.vehicle.wheel_radius)
    if table.contact_filter == "patch" and table.patch_filter == "fixed":
        if not table.weight_of_press:
            return PatchMean.uniform(hertz(study).semi_axis_x)
        press = press_table(study, run)
        return PatchMean(press.offsets, press.weights_at(study.vehicle.static_load))
    return None


def point_wheel(study: Study, run: str) -> PointWheel | None:
    """The wheel of a point run if its modes move."""
    if study.wheel(run) != "modal":
        return None
    table = cached(_press_body(study, run))
    zone = dict(zip(LARGEST_ZONE, table.zone.tolist(), strict=True))
    pressed = replace(study, solid=replace(study.solid, **zone))
    return PointWheel.of(build.surface_contact(pressed, run), table)


def _point(study: Study, run: str) -> PointRun:
    table = study.runs[run]
    assert isinstance(table, PointRun)
    return table
