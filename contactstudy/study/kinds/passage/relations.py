"""What tables of a study must be to each other: time step, waves, bays, contact and mesh.

A rule finds what must go wrong, which is refused, and what may, which is warned of.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from contactstudy.dynamics.integrators import STEPS_A_PERIOD
from contactstudy.exceptions import InputError
from contactstudy.irregularity import Irregularity
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.run import Run
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import DiscreteSupports, Track
from contactstudy.validation import asked, complaint
from contactstudy.vehicle import Vehicle

STEPS_SEEN = 2
"""Fewest steps in which anything can be told from something longer."""
AS_RIGID = 100
"""A contact so many times stiffer than what the beam elements can answer to is rigid to them."""
PATCH_ELEMENTS = 4
"""Fewest elements across a patch that are not warned of."""


@dataclass(frozen=True)
class Finding:
    """What a rule found: the result must be `wrong`, or may be."""

    text: str
    wrong: bool


@dataclass(frozen=True)
class Related:
    """Tables of a study that rules relate, None for those that failed; the `radius` of its wheels.

    `stiffness` is what is known of the contact stiffness of a run by its name [N/m].
    """

    journey: Journey
    track: Track | None
    vehicle: Vehicle | None
    radius: float
    irregularity: Irregularity | None
    runs: Mapping[str, Run]
    stiffness: Mapping[str, float]

    def findings(self) -> list[Finding]:
        """What all rules find."""
        found = []
        for key, (step, runs) in self._steps().items():
            found += asked(self._waves, key, step, runs) + asked(self._bays, key, step, runs)
        for name, run in self.runs.items():
            found += asked(self._of_run, name, run)
        return found

    def _of_run(self, name: str, run: Run) -> Iterator[Finding]:
        beam, problems = self._beam(name, run)
        yield from (Finding(text, True) for text in problems)
        if isinstance(run, PointRun) and (stiffness := self._stiffness_of(name, run)):
            yield from self._contact(name, run, stiffness, beam)

    def _steps(self) -> dict[str, tuple[float, dict[str, Run]]]:
        """Key of each time step that is possible -> the step [s], and the runs that have it."""
        found: dict[str, tuple[float, dict[str, Run]]] = {}
        for name, run in self.runs.items():
            for key, step in asked(self._possible, name, run):
                found.setdefault(key, (step, {}))[1][name] = run
        return found

    def _possible(self, name: str, run: Run) -> Iterator[tuple[str, float]]:
        key = "journey.time_step" if run.time_step is None else f"runs.{name}.time_step"
        step = run.step(self.journey.time_step)
        if not self.journey.problems_of_step(key, step):
            yield key, step

    def _waves(self, key: str, step: float, runs: Mapping[str, Run]) -> Iterator[Finding]:
        """A wave takes `STEPS_A_PERIOD` steps to pass; one below two is taken for a longer one."""
        if all(run.irregularity == "smooth" for run in runs.values()):
            return
        for name, wave in self._shortest_waves().items():
            yield from self._passing(
                f"irregularity.{name}: a wave of {wave:.3g} m", wave, key, step
            )

    def _shortest_waves(self) -> dict[str, float]:
        """Key of the irregularity -> shortest wave that it gives [m], or length of a defect."""
        table = self.irregularity
        if table is None:
            return {}
        waves = {}
        if table.spectrum == "sinusoid":
            waves["wavelength"] = table.wavelength
        if table.generated:
            waves["band"] = 2.0 * math.pi / table.band[1]
        if table.spectrum == "measured":
            waves["wavelengths"] = table.wavelengths[0]
        rail, wheel = table.rail_defect, table.wheel_defect
        if rail is not None and hasattr(rail, "wavelength"):
            waves["rail_defect_wavelength"] = rail.wavelength
        elif rail is not None and rail.half_length:
            waves["rail_defect"] = 2.0 * rail.half_length
        if isinstance(wheel, LocalDefect):
            with contextlib.suppress(InputError):  # complained about
                waves["wheel_defect"] = 2.0 * wheel.half_length(self.radius)
        return {name: wave for name, wave in waves.items() if wave}

    def _bays(self, key: str, step: float, runs: Mapping[str, Run]) -> Iterator[Finding]:
        """A bay, whose stiffness varies once, is passed as a wave is; so are beam elements."""
        track = self.track
        if track is None or not isinstance(track.support, DiscreteSupports):
            return
        spacing = track.support.spacing
        yield from self._passing(f"track.spacing: a bay of {spacing:g} m", spacing, key, step)
        way = self.journey.speed * step
        for name, run in runs.items():
            if not isinstance(run, PointRun) or run.needs_solid:
                continue
            element = spacing / run.elements_per_bay
            if way > element:
                text = f"{key} = {step:g} s: the wheel moves {way:.3g} m a step at "
                text += f"{self.journey.speed:g} m/s, past whole beam elements of {element:.3g} m "
                yield Finding(
                    f"{text}(runs.{name}.elements_per_bay = {run.elements_per_bay})", False
                )

    def _passing(self, what: str, length: float, key: str, step: float) -> Iterator[Finding]:
        steps = self.journey.steps_over(length, step)
        if steps >= STEPS_A_PERIOD:
            return
        needed = length / (self.journey.speed * STEPS_A_PERIOD)
        digit = 10.0 ** (math.floor(math.log10(needed)) - 1)
        needed = math.floor(needed / digit) * digit  # rounded up it would be too long again
        if steps < STEPS_SEEN:
            text = "must be longer than two time steps, or is taken for a longer one"
        else:
            error = 100 * (2 * math.pi / steps) ** 2 / 12
            text = f"below {STEPS_A_PERIOD} the time stepper is {error:.2g} % off in its frequency"
        way = self.journey.speed * step
        yield Finding(
            f"{what} passes in {steps:.2g} time steps at {self.journey.speed:g} m/s "
            f"({key} = {step:g} s, {way:.3g} m a step): {text}; use at most {needed:.2g} s",
            steps < STEPS_SEEN,
        )

    def _beam(self, name: str, run: Run) -> tuple[BeamTrack | None, list[str]]:
        """The beam of a point run, or why there is none; nothing for other runs."""
        track = self.track
        if not isinstance(run, PointRun) or run.rail == "solid" or track is None:
            return None, []
        if track.structure is not None:
            return None, []
        try:
            beam = BeamTrack(track, run.rail, run.elements_per_bay, direction=run.direction)
        except InputError as error:
            return None, [p.replace("BeamTrack.", f"runs.{name}.") for p in error.problems]
        return beam, []

    def _stiffness_of(self, name: str, run: PointRun) -> float | None:
        given = run.law == "linear" and isinstance(run.k_r, float)
        return float(run.k_r) if given else self.stiffness.get(name)

    def _contact(
        self, name: str, run: PointRun, k: float, beam: BeamTrack | None
    ) -> Iterator[Finding]:
        """A contact that vibrates faster than steps or elements can follow chatters undamped.

        The wheel on its contact has ``omega^2 = k b M^-1 b`` at least, the rail's motion raises it.
        """
        if not run.undamped or run.law == "moving_force":
            return
        found = []
        step = run.step(self.journey.time_step)
        possible = not self.journey.problems_of_step("", step)
        if self.vehicle is not None and possible:
            b = self.vehicle.contact_rows
            inverse = np.einsum("ij,ji->i", b, np.linalg.solve(self.vehicle.mass, b.T)).max()
            period = 2.0 * math.pi / math.sqrt(k * float(inverse))
            if period < STEPS_A_PERIOD * step:
                text = (
                    f"the wheel vibrates on its contact of {k:.3g} N/m with a period of "
                    f"{period:.2g} s, {period / step:.2g} time steps"
                )
                found.append((text, period < STEPS_SEEN * step))
        if beam is not None:
            ratio = k / beam.stiffest
            if ratio > 1.0:
                text = (
                    f"a contact of {k:.3g} N/m is {ratio:.2g} times as stiff as the shortest wave "
                    f"of the beam elements, {beam.stiffest:.2g} N/m, and rings on them"
                )
                found.append((text, ratio > AS_RIGID))
        if found:
            wrong = any(each for _, each in found)
            text = " and ".join(each for each, _ in found)
            key = "k_r" if run.law == "linear" else "law"
            yield Finding(
                f"runs.{name}.{key}: {text}; without numerical damping the force "
                f"{'chatters' if wrong else 'may chatter'}: use "
                'integrator = "generalised_alpha", or a smaller '
                f"{'k_r' if run.law == 'linear' else 'time step'}",
                wrong,
            )


def meshed_patch(
    axes: tuple[float, float], zone: tuple[float, float], mesh_size: float, exact: bool
) -> list[Finding]:
    """Hertz's patch at rest on its mesh; where he does not hold, as `exact` says, only doubts.

    Semi-axes along and across the rail, half lengths of the finely meshed zone in the same
    directions, and element size, all in m.
    """
    found = []
    keys = "contact_half_length", "contact_half_width"
    for axis, half, key, way in zip(axes, zone, keys, ("long", "wide"), strict=True):
        if half < axis:
            text = f"must reach beyond Hertz's patch, {2e3 * axis:.3g} mm {way} at rest"
            found.append(Finding(complaint(f"solid.{key}", half, text), exact))
    across = 2.0 * min(axes)
    n = across / mesh_size
    if n < PATCH_ELEMENTS:
        text = f"{n:.2g} elements across Hertz's patch at rest, {1e3 * across:.3g} mm; "
        text += (
            "must be smaller than the patch"
            if n < 1.0
            else (f"below {PATCH_ELEMENTS} pressure, area and force depend on where the mesh lies")
        )
        found.append(Finding(complaint("solid.mesh_size", mesh_size, text), exact and n < 1.0))
    return found
