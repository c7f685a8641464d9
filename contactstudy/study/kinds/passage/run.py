"""What all tables ``[runs.NAME]`` of a study file have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from contactstudy.dynamics import integrators
from contactstudy.validation import Above, Multiples, Parameters, Unit, When, multiple
from contactstudy.validation import quantities as q


@dataclass(frozen=True)
class Run(Parameters):
    """Keys of every run; a time step may be a multiple of the journey's, "0.5 x journey"."""

    time_step: Annotated[
        float | Literal["journey"] | None, Unit("s"), Above(0), Multiples(("journey",)),
        "time step; that of the journey if left out",
    ] = None  # fmt: skip
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

    def step(self, journey: float) -> float:
        """Time step in s, on a journey whose own is `journey` [s]."""
        if isinstance(self.time_step, str):
            return multiple(self.time_step)[0] * journey
        return journey if self.time_step is None else self.time_step

    def method(self) -> integrators.Integrator:
        """The time stepper."""
        if self.stepper == "generalised_alpha":
            return integrators.generalised_alpha(self.rho_inf)
        return integrators.average_acceleration()

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, the integrator chosen."""
        return super().resolved() | {"integrator": self.stepper}
