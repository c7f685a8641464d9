"""Sections of bridge decks, by name or given.

The centroid counts as the shear centre too. What a source does not give is None: such a deck can
carry a planar run only.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from contactstudy.track.space_beam import SpaceBeam
from contactstudy.validation import Above, Key, Parameters, Unit, Usual
from contactstudy.validation import quantities as q

_SecondMoment = Annotated[float, Unit("m^4"), Above(0)]


@dataclass(frozen=True)
class DeckSection(Parameters):
    """A deck's section, whole (both tracks of a double-track bridge)."""

    youngs_modulus: float = 34.5e9
    area: float = 8.889
    second_moment: float = 10.947
    lateral_second_moment: float | None = 86.2
    torsion_constant: float | None = 22.65
    mass_per_length: float = 34e3
    poisson_ratio: float = 0.2
    damping_ratio: float = 0.01

    @property
    def missing(self) -> list[str]:
        """Fields that a run in space needs and that are not known."""
        needed = ("lateral_second_moment", "torsion_constant")
        return [name for name in needed if getattr(self, name) is None]

    @property
    def beam(self) -> SpaceBeam:
        """Euler beam; unknown lateral values stand as large ones, which a planar run never feels.

        The mass counts as spread like the section: polar inertia m (I_y + I_z)/A.
        """
        E, lateral, J = self.youngs_modulus, self.lateral_second_moment, self.torsion_constant
        lateral = self.second_moment if lateral is None else lateral
        J = self.second_moment if J is None else J
        return SpaceBeam(
            axial_stiffness=E * self.area,
            bending_stiffness=E * self.second_moment,
            lateral_bending_stiffness=E * lateral,
            torsion_stiffness=E / (2.0 * (1.0 + self.poisson_ratio)) * J,
            mass_per_length=self.mass_per_length,
            polar_inertia=self.mass_per_length * (self.second_moment + lateral) / self.area,
        )

    def frequency(self, span: float) -> float:
        """First bending frequency of a simply supported span [m], vertical [Hz].

        f = pi / (2 L^2) sqrt(EI / m).
        """
        stiffness = self.youngs_modulus * self.second_moment
        return math.pi / (2.0 * span**2) * math.sqrt(stiffness / self.mass_per_length)

    def lateral_frequency(self, span: float) -> float | None:
        """The same of lateral bending; None where it is not known."""
        if self.lateral_second_moment is None:
            return None
        return self.frequency(span) * math.sqrt(self.lateral_second_moment / self.second_moment)


class Box32m(DeckSection):
    """Double-track concrete box of 32 m of China's high-speed lines, about 34 t/m with track.

    Sections of published studies of the 32 m simply supported box; its damping of 1 % is that of
    EN 1991-2, table 6.6, for prestressed concrete from 20 m on.
    """


@dataclass(frozen=True)
class Antoing(DeckSection):
    """Antoing bridge: 50 m, E 35 GPa, I 51.3 m^4, 69 t/m, 1 % damping.

    H. Xia, G. De Roeck, H. R. Zhang and N. Zhang, Eng. Struct. 25 (2003). Lateral values are not
    given there; the area decides nothing in a planar run.
    """

    youngs_modulus: float = 35e9
    area: float = 10.0
    second_moment: float = 51.3
    lateral_second_moment: float | None = None
    torsion_constant: float | None = None
    mass_per_length: float = 69e3


@dataclass(frozen=True)
class GivenDeck(DeckSection):
    """A deck by its values."""

    youngs_modulus: Annotated[
        q.Modulus, Usual(5e9, 2.5e11), Key("deck_youngs_modulus"), "of the deck"
    ] = 34.5e9
    area: Annotated[
        float, Unit("m^2"), Above(0), Key("deck_area"), "area of the deck's section"
    ] = 8.889
    second_moment: Annotated[
        _SecondMoment, Key("deck_second_moment"), "of the deck, vertical bending"
    ] = 10.947
    lateral_second_moment: Annotated[
        float | None, Unit("m^4"), Above(0), Key("deck_lateral_second_moment"),
        "of the deck, lateral bending; a run in space needs it",
    ] = None  # fmt: skip
    torsion_constant: Annotated[
        float | None, Unit("m^4"), Above(0), Key("deck_torsion_constant"),
        "of the deck; a run in space needs it",
    ] = None  # fmt: skip
    mass_per_length: Annotated[
        q.MassPerLength, Usual(100.0, 5e5), Key("deck_mass_per_length"),
        "of the deck with all that is fixed to it, but for the rails and sleepers of the track",
    ] = 34e3  # fmt: skip
    poisson_ratio: Annotated[q.PoissonRatio, Key("deck_poisson_ratio"), "of the deck"] = 0.2
    damping_ratio: Annotated[
        q.Fraction, Key("deck_damping_ratio"),
        "of the deck at the two frequencies of its Rayleigh damping",
    ] = 0.01  # fmt: skip


def rayleigh(ratio: float, first: float, second: float) -> tuple[float, float]:
    """Coefficients (a, b) of C = a M + b K with a damping ratio at two frequencies [Hz].

    zeta(omega) = a / (2 omega) + b omega / 2, so a = 2 zeta w1 w2/(w1 + w2), b = 2 zeta/(w1 + w2).
    """
    w1, w2 = 2.0 * math.pi * first, 2.0 * math.pi * second
    return 2.0 * ratio * w1 * w2 / (w1 + w2), 2.0 * ratio / (w1 + w2)


def realised_ratio(coefficients: tuple[float, float], frequency: np.ndarray) -> np.ndarray:
    """Damping ratio of Rayleigh coefficients (a, b) at frequencies [Hz]."""
    omega = 2.0 * math.pi * np.asarray(frequency, dtype=float)
    return coefficients[0] / (2.0 * omega) + coefficients[1] * omega / 2.0
