"""The tables ``[runs.NAME]`` of a study file."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from pydantic import StrictBool

from contactstudy.study import quantities as q
from contactstudy.study.section import Condition, Section


class RunTable(Section):
    """Keys of every ``[runs.NAME]``."""

    time_step: q.Duration | None = None
    irregularity: Literal["study", "smooth"] = "study"
    integrator: Literal["average_acceleration", "generalised_alpha"] | None = None
    rho_inf: q.Fraction = 0.8

    applies: ClassVar[dict[str, Condition]] = {"rho_inf": ("stepper", ("generalised_alpha",))}

    @property
    def stepper(self) -> str:
        """Name of the integrator: the one given, or the one that suits the run."""
        return self.integrator or "average_acceleration"

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, the integrator chosen."""
        return super().resolved() | {"integrator": self.stepper}

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return False


class PointRun(RunTable):
    """A run with ``solver = "point"``: the paper's section 3.1, or eq. (7) with ``law``.

    ``k_r`` is a number, "tangent" (of the static press of the very wheel and rail that are
    meshed, at the static load), "hertz_tangent" (of Hertz's closed form) or "rigid".
    """

    solver: Literal["point"] = "point"
    rail: Literal["euler", "timoshenko", "solid"] = "euler"
    elements_per_bay: q.Count = 4
    local_compliance: StrictBool = False
    law: Literal["linear", "hertz"] = "linear"
    k_r: q.ContactStiffness = 1e11
    direction: Literal["Z", "Y"] = "Z"

    applies: ClassVar[dict[str, Condition]] = RunTable.applies | {
        "elements_per_bay": ("rail", ("euler", "timoshenko")),
        "local_compliance": ("rail", ("euler", "timoshenko")),
        "k_r": ("law", ("linear",)),
    }

    @property
    def stepper(self) -> str:
        """As in `RunTable`; a rigid contact needs numerical damping."""
        rigid = self.law == "linear" and self.k_r == "rigid"
        return self.integrator or ("generalised_alpha" if rigid else "average_acceleration")

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return self.rail == "solid"


class SurfaceRun(RunTable):
    """A run with ``solver = "surface"``: meshed wheel on meshed rail.

    ``wheel`` is the study's when not given.
    """

    solver: Literal["surface"] = "surface"
    wheel: Literal["rigid", "quasi-static", "modal"] | None = None

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return True
