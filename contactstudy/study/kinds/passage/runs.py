"""The tables ``[runs.NAME]`` of a study file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

from contactstudy.dynamics import integrators
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.solid import WheelModel
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Direction
from contactstudy.validation import (
    Above,
    Naming,
    Parameters,
    Same,
    Unit,
    Variants,
    When,
    complaint,
)
from contactstudy.validation import quantities as q

_BEAM = When("rail", "euler", "timoshenko")


@dataclass(frozen=True)
class Run(Parameters):
    """Keys of every run."""

    time_step: Annotated[
        float | None, Same(Journey, "time_step"), "time step; that of the journey if left out"
    ] = None
    irregularity: Annotated[Literal["study", "smooth"], "the study's, or none"] = "study"
    integrator: Annotated[
        Literal["average_acceleration", "generalised_alpha"] | None,
        "time stepper; the one that suits the run if left out",
    ] = None
    rho_inf: Annotated[
        q.Fraction, When("stepper", "generalised_alpha", key="integrator"),
        "spectral radius at infinite frequency",
    ] = 0.8  # fmt: skip

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return True

    @property
    def stepper(self) -> str:
        """Name of the integrator: the one given, or the one that suits the run."""
        return self.integrator or "average_acceleration"

    def method(self) -> integrators.Integrator:
        """The time stepper."""
        if self.stepper == "generalised_alpha":
            return integrators.generalised_alpha(self.rho_inf)
        return integrators.average_acceleration()

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, the integrator chosen."""
        return super().resolved() | {"integrator": self.stepper}


@dataclass(frozen=True)
class PointRun(Run):
    """The paper's section 3.1, or eq. (7) with ``law``.

    ``k_r`` is a number, "tangent" (of the static press of the very wheel and rail that are
    meshed, at the static load), "hertz_tangent" (of Hertz's closed form) or "rigid".
    """

    solver: ClassVar[str] = "point"

    rail: Annotated[
        Literal["euler", "timoshenko", "solid"], "theory of the beam, or the meshed rail"
    ] = "euler"
    elements_per_bay: Annotated[int, Same(BeamTrack, "elements_per_bay"), _BEAM] = (
        BeamTrack.elements_per_bay
    )
    local_compliance: Annotated[bool, Same(BeamTrack, "element_compliance"), _BEAM] = (
        BeamTrack.element_compliance
    )
    law: Annotated[Literal["linear", "hertz"], "contact law"] = "linear"
    k_r: Annotated[
        float | Literal["tangent", "hertz_tangent", "rigid"], Unit("N/m"), Above(0),
        When("law", "linear"), "contact stiffness",
    ] = 1e11  # fmt: skip
    direction: Annotated[Direction, Same(BeamTrack, "direction")] = BeamTrack.direction

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return self.rail == "solid"

    @property
    def rigid(self) -> bool:
        """Whether the contact does not give way."""
        return self.law == "linear" and self.k_r == "rigid"

    @property
    def stepper(self) -> str:
        """As in `Run`; a rigid contact needs numerical damping."""
        return self.integrator or ("generalised_alpha" if self.rigid else "average_acceleration")

    def problems(self, key: Naming) -> list[str]:
        """Lateral runs that are not possible, and a rigid contact without damping."""
        problems = []
        if self.rail == "solid" and self.direction == "Y":
            problems.append(complaint(key("direction"), "Y", 'must be "Z" on the solid rail'))
        if self.law == "hertz" and self.direction == "Y":
            problems.append(complaint(key("direction"), "Y", 'must be "Z" with law = "hertz"'))
        undamped = self.stepper == "average_acceleration" or self.rho_inf > 1.0 - 1e-6
        if self.rigid and undamped:
            allowed = 'must be "generalised_alpha" with rho_inf below 1 where k_r = "rigid"'
            problems.append(complaint(key("integrator"), self.stepper, allowed))
        return problems


@dataclass(frozen=True)
class SurfaceRun(Run):
    """Meshed wheel on meshed rail; ``wheel`` is the study's when not given."""

    solver: ClassVar[str] = "surface"

    wheel: Annotated[WheelModel | None, "model of the meshed wheel; the study's if left out"] = None


SOLVERS = Variants("solver", {"point": PointRun, "surface": SurfaceRun}, "how the run is solved")
