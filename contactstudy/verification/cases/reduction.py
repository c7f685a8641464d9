"""The condensed rail in motion against the same mesh with inertia in every node."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity.estimate import ThirdOctaves, third_octave_levels
from contactstudy.irregularity.limit import iso_3095_profile
from contactstudy.plot.curves import Plot, curve
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import DiscreteSupports, Support, Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.vehicle import wheel_column
from contactstudy.verification.check import CaseResult, Check, ResultTable

SPEED = 300 / 3.6
SIZE = 0.004
SETTLED = 1e-3
"""s; before it the dent sets off from rest to full speed within one step."""
LARGEST, LEVEL = 0.005, 0.05
"""Bands: largest difference over the static load, and of each third octave (0.4 dB)."""
SOURCE = "every node with inertia"


@dataclass(frozen=True)
class Passage:
    """Contact forces (n,) in N of both rails over time (n,) in s."""

    time: Array
    reduced: Array
    full: Array
    dofs: tuple[int, int]
    static: float


def passage() -> CaseResult:
    """Default supports but for the pads' length, mesh of 4 mm."""
    # a pad with a length couples all nodes above it: the full rail's band would not fit in memory
    support = DiscreteSupports(pad_length=0.0)
    return _result(both_rails(CellRecipe(size=SIZE), support, shortest=0.016))


def both_rails(recipe: CellRecipe, support: Support, shortest: float) -> Passage:
    """Condensed and full rail under roughness from 400 mm down to a shortest wave [m]."""
    track = Track(rail=solid_rail(recipe), length=1.2, support=support)
    wheel = elastic_wheel(WheelRecipe(size=recipe.size))
    profile = iso_3095_profile(1, (shortest, 0.4))
    # whole parts of a slice, so that the mesh's own ripple is no matter
    step = recipe.thickness / 2
    journey = Journey(start=0.3, end=0.9, speed=SPEED, time_step=step / SPEED, fade_in=0.08)
    forces, dofs = [], []
    # both rails have the mesh's own phase under the wheel (`mean_phase` is off)
    for rail in (SolidTrack(track, condense(recipe), False), UnreducedTrack(track, recipe)):
        data = surface_contact(rail, SurfaceContact(wheel), wheel_column(), profile, journey)
        forces.append(np.asarray(data.contact_force.values, dtype=float))
        dofs.append(rail.n_dofs)
    static = float(wheel_column().static_loads[0])
    return Passage(data.time.values, forces[0], forces[1], (dofs[0], dofs[1]), static)


def third_octaves(signal: Array, step: float, highest: float = 5000.0) -> ThirdOctaves:
    """From 800 Hz up, of a signal with a time step [s]."""
    return third_octave_levels(signal, step, reference=1.0, band=(800.0, highest))


def _result(found: Passage) -> CaseResult:
    settled = found.time >= SETTLED
    step = float(found.time[1] - found.time[0])
    difference = found.reduced - found.full
    full, reduced, rest = (
        third_octaves(signal[settled], step) for signal in (found.full, found.reduced, difference)
    )
    dynamic = float(np.std(found.full[settled]))
    rms = float(np.sqrt(np.mean(difference[settled] ** 2)))
    largest = float(np.abs(difference[settled]).max())
    checks = [
        Check("largest difference", largest, 0.0, "N", SOURCE, LARGEST, scale=found.static),
        Check("rms of the difference", rms, 0.0, "N", SOURCE, None, scale=dynamic),
    ]
    checks += [
        Check(f"third octave {f:g} Hz", float(np.sqrt(a)), float(np.sqrt(b)), "N", SOURCE, LEVEL)
        for f, a, b in zip(full.nominal, reduced.mean_square, full.mean_square, strict=True)
    ]
    rows = tuple(
        (
            float(f),
            1e3 * SPEED / float(c),
            float(np.sqrt(m)),
            float(np.sqrt(d)),
            round(100 * float(np.sqrt(d / m)), 2),
        )
        for f, c, m, d in zip(
            full.nominal, full.centre, full.mean_square, rest.mean_square, strict=True
        )
    )
    header = ("band (Hz)", "wavelength (mm)", "force (N)", "difference (N)", "difference (%)")
    early = float(np.abs(difference[~settled]).max()) / found.static
    reduced_dofs, full_dofs = found.dofs
    method = (
        "A wheel runs at 300 km/h over the middle of 1.2 m of rail, clamped at both ends, with the "
        "roughness limit of ISO 3095 from 400 to 16 mm (random phases). The mesh has 4 mm; "
        "sleepers, pads (without length) and ballast are the defaults. Once the rail is made of "
        f"condensed cells with residual flexibility ({reduced_dofs} dofs), once it keeps every "
        f"node with its inertia ({full_dofs} dofs). Wheel, contact, roughness and steps are the "
        "same.\n\n"
        "Third octaves are those of the contact force after the first millisecond (Hann window "
        "over the whole record). In the first millisecond the dent sets off from rest to full "
        "speed; the residual flexibility has no inertia to feel that, and the forces differ by up "
        f"to {100 * early:.2f} % of the static load. The largest difference is held against the "
        f"static load of {found.static * 1e-3:.4g} kN, the rms of the difference against that of "
        "the dynamic force, the third octaves against their own."
    )
    return CaseResult(
        "reduction",
        "Condensed rail against every node in motion, third octaves to 5 kHz",
        method,
        tuple(checks),
        (ResultTable("Root mean squares in the third octaves.", header, rows),),
        _plots(found, full, rest),
    )


def _plots(found: Passage, full: ThirdOctaves, rest: ThirdOctaves) -> tuple[Plot, Plot]:
    t = 1e3 * found.time
    return (
        Plot(
            "Contact force of both rails.",
            "Time (ms)",
            "Contact force (kN)",
            (
                curve("every node", t, 1e-3 * found.full, "reference"),
                curve("condensed", t, 1e-3 * found.reduced),
            ),
        ),
        Plot(
            "Third octaves of the contact force and of the difference.",
            "Frequency (Hz)",
            "Root mean square (N)",
            (
                curve("every node", full.centre, np.sqrt(full.mean_square), "reference"),
                curve("difference", full.centre, np.sqrt(rest.mean_square), "both"),
            ),
            "log",
            "log",
        ),
    )
