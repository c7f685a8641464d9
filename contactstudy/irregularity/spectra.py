"""Power spectral densities of track irregularities, by name."""

import difflib
import inspect
from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.psd import TWO_SIDED, Convention, Sides, Spectrum
from contactstudy.validation import not_negative, positive, raise_if


def paper_spectrum(
    roughness: float = 0.8e-7, omega_1: float = 0.0, omega_2: float = 1.0
) -> Spectrum:
    """Eq. (3) of the paper; the defaults are its Table 1.

    Roughness A_r in m^2 rad/m, wavenumbers omega_1 and omega_2 in rad/m.
    """
    raise_if(
        positive("roughness", roughness, "m^2*rad/m")
        + not_negative("omega_1", omega_1, "rad/m")
        + positive("omega_2", omega_2, "rad/m")
    )

    def formula(w: Array) -> Array:
        # G_rr = A_r w2^2 (w^2 + w1^2)/(w^4 (w^2 + w2^2))
        return roughness * omega_2**2 * (w**2 + omega_1**2) / (w**4 * (w**2 + omega_2**2))

    return Spectrum("paper", formula, TWO_SIDED)


_GERMAN = {"vertical": (4.032e-7, 1.08e-6), "lateral": (2.119e-7, 6.125e-7)}


def german(
    level: Literal["low", "high"] = "low",
    direction: Literal["vertical", "lateral"] = "vertical",
    sides: Sides = "one",
) -> Spectrum:
    """German spectra of low and high disturbance (ERRI B176; Claus and Schiehlen 1998).

    Parameters
    ----------
    level
        Disturbance.
    direction
        Longitudinal level or alignment.
    sides
        How the formula is read; two-sided doubles the variance.

    Notes
    -----
    ERRI B176 is not public, and papers that print the formula mostly do not say how it is meant.
    One-sided in rad/m is the practice of open programs, which integrate it over positive
    wavenumbers alone: ORVD (its documentation "Track-irregularity spectra", which quotes SIMPACK's
    library with these very coefficients, ``A w_c^2`` = 2.741619e-7 and 7.343623e-7 m^2 (rad/m)^3
    vertically) and TTB-2D (D. Cantero, SoftwareX 20 (2022) 101253). Low disturbance then has a
    standard deviation of 0.98 mm from 3 to 25 m.
    """
    _one_of("german", "level", level, ("low", "high"))
    _one_of("german", "direction", direction, tuple(_GERMAN))
    _one_of("german", "sides", sides, ("two", "one"))
    a = _GERMAN[direction][0 if level == "low" else 1]
    omega_c, omega_r = 0.8246, 0.0206

    def formula(w: Array) -> Array:
        # S = A w_c^2/((w^2 + w_r^2)(w^2 + w_c^2))
        return a * omega_c**2 / ((w**2 + omega_r**2) * (w**2 + omega_c**2))

    name = f"German {level} disturbance" + ("" if direction == "vertical" else ", lateral")
    return Spectrum(name, formula, Convention(sides))


_FRA = {
    "vertical": (1.2107, 1.0181, 0.6816, 0.5376, 0.2095, 0.0339),
    "lateral": (3.3634, 1.2107, 0.4128, 0.3027, 0.0762, 0.0339),
}


def fra(
    track_class: int = 6,
    direction: Literal["vertical", "lateral"] = "vertical",
    sides: Sides = "one",
) -> Spectrum:
    """Spectrum of the Federal Railroad Administration's track classes 1 to 6.

    Class 1 is the worst; ``direction`` and ``sides`` as in `german`.

    Notes
    -----
    TTB-2D and ORVD (see `german`) read ``0.25 A_v w_c^2/(w^2 (w^2 + w_c^2))`` one-sided, and so
    does this program: class 6 has a standard deviation of 1.43 mm from 3 to 25 m. The documentation
    of STEM ("Irregularities model", after Zhang et al. 2001) has 2 pi in place of 0.25 and
    amplitudes ``sqrt(4 S dw)``, which is two-sided.

    The lateral A_a are those that the tables of the literature print beside A_v; no program was at
    hand to hold them against.
    """
    _one_of("fra", "track_class", track_class, tuple(range(1, 7)))
    _one_of("fra", "direction", direction, tuple(_FRA))
    _one_of("fra", "sides", sides, ("two", "one"))
    a, omega_c = _FRA[direction][track_class - 1], 0.8245

    def formula(w: Array) -> Array:
        # S = 0.25 A w_c^2/(w^2 (w^2 + w_c^2)), A_v or A_a in cm^2 rad/m
        return 0.25 * a * omega_c**2 / (w**2 * (w**2 + omega_c**2))

    name = f"FRA class {track_class}" + ("" if direction == "vertical" else ", lateral")
    return Spectrum(name, formula, Convention(sides, "rad/m", 1e-4))


# S = A/f^n in mm^2/(1/m), one-sided, f in 1/m: upper end of each range, A, n
_TBT3352 = {
    "vertical": (
        (0.0187, 1.0544e-5, 3.3891),
        (0.0474, 3.5588e-3, 1.9271),
        (0.1533, 1.9784e-2, 1.3643),
        (np.inf, 3.9488e-4, 3.4516),
    ),
    "lateral": (
        (0.0450, 3.9513e-3, 1.8670),
        (0.1234, 1.1047e-2, 1.5354),
        (np.inf, 7.5633e-4, 2.8171),
    ),
}


def tbt3352(direction: Literal["vertical", "lateral"] = "vertical") -> Spectrum:
    """Longitudinal level or alignment of Chinese ballastless high-speed track, TB/T 3352-2014."""
    _one_of("tbt3352", "direction", direction, tuple(_TBT3352))
    rows = _TBT3352[direction]
    ends = np.array([row[0] for row in rows[:-1]])
    a, n = np.array([row[1] for row in rows]), np.array([row[2] for row in rows])

    def formula(f: Array) -> Array:
        part = np.searchsorted(ends, f, side="right")
        return a[part] / f ** n[part]

    convention = Convention("one", "1/m", 1e-6)
    name = "TB/T 3352 ballastless" + ("" if direction == "vertical" else ", lateral")
    return Spectrum(name, formula, convention, tuple(ends))


_NAMED: dict[str, tuple[Callable[..., Spectrum], dict[str, Any]]] = {
    "paper": (paper_spectrum, {}),
    "german_low": (german, {"level": "low"}),
    "german_high": (german, {"level": "high"}),
    **{f"fra{i}": (fra, {"track_class": i}) for i in range(1, 7)},
    "tbt3352": (tbt3352, {}),
}
NAMES: tuple[str, ...] = tuple(_NAMED)


def spectrum(name: str, **parameters: Any) -> Spectrum:
    """Spectrum by name.

    Parameters
    ----------
    name : str
        One of ``spectra.NAMES``; capitals, blanks and dashes do not matter.
    **parameters
        Passed on: ``roughness``, ``omega_1``, ``omega_2`` for "paper"; ``direction`` for all
        others, ``sides`` for the German and the FRA spectra.

    Raises
    ------
    InputError
        If the name or a parameter is unknown, or a value is not allowed.
    """
    plain = {key.replace("_", ""): key for key in _NAMED}
    key = "".join(c for c in name.lower() if c.isalnum())
    if key not in plain:
        near = difflib.get_close_matches(key, plain, n=1)
        hint = f" (did you mean '{plain[near[0]]}'?)" if near else ""
        raise InputError(f"spectrum '{name}' is unknown{hint}; allowed: {', '.join(NAMES)}")
    make, fixed = _NAMED[plain[key]]
    allowed = [p for p in inspect.signature(make).parameters if p not in fixed]
    unknown = [p for p in parameters if p not in allowed]
    if unknown:
        raise InputError(
            f"spectrum '{plain[key]}' has no parameter '{p}'; allowed: {', '.join(allowed) or '-'}"
            for p in unknown
        )
    return make(**fixed, **parameters)


def _one_of(name: str, key: str, value: Any, allowed: tuple[Any, ...]) -> None:
    if value not in allowed:
        raise InputError(
            f"spectrum '{name}': {key} is {value!r}; allowed: {', '.join(map(str, allowed))}"
        )
