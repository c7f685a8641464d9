"""The impact forces P1 and P2: closed forms, the lumped model solved exactly, and a point run."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.compare.impact import LumpedTrack, first_peak
from contactstudy.contact.laws import LinearSpring
from contactstudy.irregularity import DippedJoint, Profile, SmoothRail, with_defects
from contactstudy.plot.curves import Plot, curve
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track, WinklerFoundation
from contactstudy.track.rail import GivenRail
from contactstudy.vehicle import bare_wheel
from contactstudy.verification.check import CaseResult, Check, check_shown

LUMPED = LumpedTrack(600.0, 1.4e9, 250.0, 80e6, 60e3)
"""About the freight wheels and the track of Jenkins's time."""
KINK = 0.4
"""2 alpha v in m/s: 10 mrad at 40 m/s."""
LENGTH, PLACE, SPEED, LOAD = 12.0, 6.0, 5.0, 400e3
"""Of the track in m, of the kink in m, of the run in m/s; static load in N, never lost."""
DURATION = 0.02
ZETA = 0.02
"""Damping ratio."""
EXACT = "closed form (Jenkins 1974)"
TWIN = "lumped model, matrix exponential"
METHOD = (
    "A wheel of 600 kg runs at 2αv = 0.4 m/s over a kink of the rail: a contact spring of 1.4 GN/m "
    "on a track of 250 kg, 80 MN/m and 60 kN s/m. First the lumped model, solved by the matrix "
    "exponential, against the closed forms in the limits in which these are exact: P1 with neither "
    "spring nor damper below the track's mass, P2 with a stiff contact; with damping P2 is right "
    "to first order in the damping ratio ζ, and what is left is (1 + π²/8) ζ². With all "
    "values as they are the difference of the closed forms is reported.\n\n"
    "Then the program's point run against the lumped model: its track is a free beam of 12 m on a "
    "Winkler foundation, with EI = 10¹⁵ N m² so stiff that it moves as one mass. The wheel crosses "
    "the kink in the middle at 5 m/s with the same 2αv; and a dipped joint, whose (1 - cos) ends "
    "the closed forms leave out."
)


@dataclass(frozen=True)
class Kink:
    """A level rail that goes up from a place on with a slope."""

    place: float
    slope: float
    domain = (-np.inf, np.inf)
    repeat_length = np.inf

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Level at positions x in m."""
        return np.asarray(self.slope * np.maximum(np.asarray(x, dtype=float) - self.place, 0.0))


def peaks(lumped: LumpedTrack, duration: float = DURATION, steps: int = 20_000) -> Array:
    """First peak of the contact force, largest force in the track's spring, exact, (2,) in N."""
    times = np.linspace(0.0, duration, steps)
    contact, track = lumped.response(times, KINK * times)
    return np.array([first_peak(contact), track.max()])


def _limits() -> list[Check]:
    loose = replace(LUMPED, track_stiffness=1.0, track_damping=0.0)
    stiff = replace(LUMPED, contact_stiffness=1e15, track_damping=0.0)
    checks = [
        check_shown("P1 without track", peaks(loose)[0], loose.p1(KINK), "kN", EXACT, 1e-6),
        check_shown("P2, stiff contact", _settled(stiff), stiff.p2(KINK), "kN", EXACT, 1e-3),
    ]
    damped = replace(
        stiff, track_damping=ZETA * 2.0 * np.sqrt(LUMPED.track_stiffness * (600.0 + 250.0))
    )
    # one mass: z_max is reduced by exp(-zeta acos(zeta)/sqrt(1 - zeta^2)), of which the closed form
    # is 1 - zeta pi/2; the next term is (1 + pi^2/8) zeta^2
    left = _settled(damped) / _settled(stiff) - damped.p2(KINK) / stiff.p2(KINK)
    second = 1.0 + np.pi**2 / 8
    checks.append(
        Check("(P2 exact - P2)/(P2 ζ²), ζ = 2 %", left / ZETA**2, second, "", "1 + π²/8", 0.05)
    )
    as_is = peaks(LUMPED)
    checks += [
        check_shown("P1, all as they are", as_is[0], LUMPED.p1(KINK), "kN", EXACT, None),
        check_shown("P2, all as they are", as_is[1], LUMPED.p2(KINK), "kN", EXACT, None),
    ]
    return checks


def _settled(lumped: LumpedTrack) -> float:
    """Largest force in the track's spring, where a contact that stiff ripples by 1e-4 of it."""
    return float(peaks(lumped, steps=4000)[1])


def _run(profile: Profile, start: float, duration: float) -> tuple[Array, Array, Array]:
    """Times, positions and dynamic contact force of the program's point run."""
    rail = GivenRail(EI=1e15, mass=LUMPED.track_mass / LENGTH)
    bed = WinklerFoundation(LUMPED.track_stiffness / LENGTH, LUMPED.track_damping / LENGTH)
    track = BeamTrack(Track(rail, bed, length=LENGTH, ends="free"), elements_per_bay=1)
    journey = Journey(start, start + SPEED * duration, SPEED, time_step=1e-5, fade_in=0.0)
    wheel, law = bare_wheel(LUMPED.unsprung_mass, LOAD), LinearSpring(LUMPED.contact_stiffness)
    data = point_contact(track, wheel, profile, journey, law=law)
    force = data.contact_force.values.ravel()
    return data.time.values, data.position.values.ravel(), force - force[0]


def p1_p2() -> CaseResult:
    """Closed forms, lumped model, and the program's point run."""
    checks = _limits()
    curves = []
    joint = DippedJoint(at=PLACE, length=0.08, depth=KINK / SPEED * 0.08 / (2 * np.pi))
    profiles: dict[str, tuple[Profile, float]] = {
        "kink": (Kink(PLACE, KINK / SPEED), PLACE),
        "dipped joint": (with_defects(SmoothRail(), joint), PLACE - 0.045),
    }
    for name, (profile, start) in profiles.items():
        times, x, force = _run(profile, start, DURATION)
        exact, _ = LUMPED.response(times, profile(x))
        largest = float(np.abs(exact).max())
        checks += [
            check_shown(f"point run, {name}: peak", force.max(), exact.max(), "kN", TWIN, 0.005),
            Check(
                f"point run, {name}: largest difference",
                1e-3 * float(np.abs(force - exact).max()),
                0.0,
                "kN",
                TWIN,
                0.01,
                scale=1e-3 * largest,
            ),
        ]
        curves.append(curve(f"lumped, {name}", 1e3 * times, 1e-3 * exact, "reference"))
        curves.append(curve(f"point run, {name}", 1e3 * times, 1e-3 * force))
    plot = Plot(
        "Dynamic contact force over a kink and over a dipped joint of the same angle.",
        "Time (ms)",
        "Contact force less static (kN)",
        tuple(curves),
    )
    title = "P1 and P2: closed forms, lumped model, point run"
    return CaseResult("p1_p2", title, METHOD, tuple(checks), (), (plot,))
