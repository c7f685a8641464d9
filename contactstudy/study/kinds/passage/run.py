"""What all tables ``[runs.NAME]`` of a study file have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from contactstudy.dynamics import integrators
from contactstudy.solvers.journey import Journey
from contactstudy.validation import Parameters, Same, When
from contactstudy.validation import quantities as q


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
