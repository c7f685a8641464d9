"""The tables ``[runs.NAME]`` of a study file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

from contactstudy.contact.laws import LATERAL_STIFFNESS
from contactstudy.solvers.journey import Travel
from contactstudy.study.kinds.passage.run import Run
from contactstudy.study.kinds.passage.solid import WheelModel
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Direction
from contactstudy.validation import (
    Above,
    Multiples,
    Naming,
    Same,
    Unit,
    Usual,
    Variants,
    When,
    complaint,
    multiple,
)
from contactstudy.validation import quantities as q

_BEAM = When("rail", "euler", "timoshenko")


@dataclass(frozen=True)
class PointRun(Run):
    """The paper's section 3.1, or another law and filter of the contact at a point.

    ``k_r`` is a number, "tangent" or "secant" (of the static press of the very wheel and rail that
    are meshed, at the static load), "hertz_tangent" or "hertz_secant" (of Hertz's closed form), a
    multiple of these, or "rigid". With ``hertz_constant = "press"`` Hertz's law has the press's
    tangent at the static load; ``law = "press"`` is the press itself. With ``law = "moving_force"``
    each wheel presses with its static load, whatever it and the rail do.

    ``contact_filter`` says what the contact makes of the irregularity, see
    `contactstudy.contact.filters` and `contactstudy.contact.patch_laws`.
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
    bay_compliance: Annotated[
        bool, _BEAM, "static give under the wheel over a bay as that of the meshed rail"
    ] = False
    law: Annotated[
        Literal["linear", "hertz", "press", "moving_force"],
        "contact law; the press is that of the meshed bodies, a moving force the static load",
    ] = "linear"
    k_r: Annotated[
        float | Literal["tangent", "secant", "hertz_tangent", "hertz_secant", "rigid"], Unit("N/m"),
        Above(0), Usual(1e7, 1e14),
        Multiples(("tangent", "secant", "hertz_tangent", "hertz_secant")),
        When("law", "linear"), "contact stiffness",
    ] = 1e11  # fmt: skip
    lateral_k_r: Annotated[
        q.Stiffness, "contact stiffness across the rail, of vehicles in three dimensions"
    ] = LATERAL_STIFFNESS
    travel: Annotated[
        Travel, "over a bridge to +X, or to -X from the far end; the journey's positions count from"
        " where the train enters"
    ] = "forward"  # fmt: skip
    hertz_constant: Annotated[
        Literal["closed_form", "press"], When("law", "hertz"),
        "k_H of Hertz's closed form, or with the tangent of the press",
    ] = "closed_form"  # fmt: skip
    contact_filter: Annotated[
        Literal["none", "trajectory", "patch", "bedding"],
        "r as it is, where a rigid wheel rests on it, its mean over the patch, or a Winkler bedding"
        " over the patch",
    ] = "none"
    patch_filter: Annotated[
        Literal["fixed", "following"], When("contact_filter", "patch"),
        "the patch at the static load, or following the load",
    ] = "fixed"  # fmt: skip
    patch_weight: Annotated[
        Literal["hertz", "press"] | None, When("contact_filter", "patch"),
        "mean over Hertz's ellipse, or weights of the press; as the law if left out",
    ] = None  # fmt: skip
    wheel: Annotated[
        WheelModel | None,
        "model of the wheel: its give is in the law, its modes beside it; the study's if left out"
        " and not modal",
    ] = None
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
    def law_of_press(self) -> bool:
        """Whether the contact stiffness comes from the press of the meshed bodies."""
        if self.law == "linear":
            return isinstance(self.k_r, str) and multiple(self.k_r)[1] in ("tangent", "secant")
        return self.law == "press" or self.hertz_constant == "press"

    @property
    def law_of_hertz(self) -> bool:
        """Whether the run needs Hertz's closed form, which conformal profiles do not have."""
        if self.contact_filter in ("patch", "bedding") and not self.weight_of_press:
            return True
        if self.law == "linear":
            return isinstance(self.k_r, str) and multiple(self.k_r)[1].startswith("hertz")
        return self.law == "hertz" and self.hertz_constant == "closed_form"

    @property
    def weight_of_press(self) -> bool:
        """Whether the patch filter's weights come from the press."""
        if self.contact_filter != "patch":
            return False
        return self.law_of_press if self.patch_weight is None else self.patch_weight == "press"

    @property
    def stepper(self) -> str:
        """As in `Run`; a rigid contact needs numerical damping, and so do moving forces.

        Constant forces that pass from element to element make accelerations of the rail ring: they
        have no wheel whose mass could give way.
        """
        damped = self.rigid or self.law == "moving_force"
        return self.integrator or ("generalised_alpha" if damped else "average_acceleration")

    @property
    def undamped(self) -> bool:
        """Whether the stepper has no numerical damping."""
        return self.stepper == "average_acceleration" or self.rho_inf > 1.0 - 1e-6

    @property
    def presses(self) -> bool:
        """Whether the run needs the press of the meshed bodies."""
        return self.law_of_press or self.patch_of_press

    @property
    def patch_of_press(self) -> bool:
        """Whether it needs more of the press than its stiffness: where the forces act."""
        return self.weight_of_press or self.wheel == "modal"

    def resolved(self) -> dict[str, Any]:
        """As in `Run`; the wheel only where the run has its own."""
        values = super().resolved()
        if "patch_weight" in values:
            values["patch_weight"] = "press" if self.weight_of_press else "hertz"
        return values if self.wheel else {k: values[k] for k in values if k != "wheel"}

    def problems(self, key: Naming) -> list[str]:
        """Lateral runs that are not possible, laws that have no patch, undamped rigid contact."""
        vertical = {
            "on the solid rail": self.rail == "solid",
            f'with law = "{self.law}"': self.law != "linear",
            f'with contact_filter = "{self.contact_filter}"': self.contact_filter != "none",
            'with wheel = "modal"': self.wheel == "modal",
            "with bay_compliance": self.bay_compliance,
        }
        problems = [
            complaint(key("direction"), "Y", f'must be "Z" {where}')
            for where, holds in vertical.items()
            if holds and self.direction == "Y"
        ]
        if self.law == "moving_force" and self.contact_filter != "none":
            allowed = 'must be "none" with law = "moving_force", which does not feel the rail'
            problems.append(complaint(key("contact_filter"), self.contact_filter, allowed))
        if self.law == "moving_force" and self.wheel == "modal":
            problems.append(complaint(key("wheel"), "modal", 'applies not with "moving_force"'))
        if self.contact_filter == "bedding" and self.law != "hertz":
            allowed = 'must be "hertz" with contact_filter = "bedding", which spreads Hertz\'s law'
            problems.append(complaint(key("law"), self.law, allowed))
        if self.bay_compliance and self.rail != "solid" and not self.local_compliance:
            allowed = "must be true with bay_compliance, which adds what a beam cannot have"
            problems.append(complaint(key("local_compliance"), False, allowed))
        following = self.contact_filter == "patch" and self.patch_filter == "following"
        if following and self.law == "linear":
            allowed = 'must be "hertz" or "press" with patch_filter = "following"'
            problems.append(complaint(key("law"), self.law, allowed))
        if self.rigid and self.undamped:
            allowed = 'must be "generalised_alpha" with rho_inf below 1 where k_r = "rigid"'
            problems.append(complaint(key("integrator"), self.stepper, allowed))
        return problems


@dataclass(frozen=True)
class SurfaceRun(Run):
    """Meshed wheel on meshed rail; ``wheel`` is the study's when not given."""

    solver: ClassVar[str] = "surface"

    wheel: Annotated[WheelModel | None, "model of the meshed wheel; the study's if left out"] = None


SOLVERS = Variants("solver", {"point": PointRun, "surface": SurfaceRun}, "how the run is solved")
