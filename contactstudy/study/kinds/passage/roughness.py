"""The irregularity of a study: the profile that runs use, and what Fig. 1 shows of it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from contactstudy import irregularity as irr
from contactstudy.exceptions import InputError
from contactstudy.given_files import content_digest
from contactstudy.irregularity.depth_doubts import doubtful as doubtful_map
from contactstudy.irregularity.doubtful import doubtful
from contactstudy.irregularity.shown import IrregularityInfo, Level, SpectrumCurve
from contactstudy.study.kinds.passage.level import sampled
from contactstudy.study.kinds.passage.placing import geometry
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.track.model import Direction

MOST_LEFT_OUT = 0.5  # of a record's variance, by wavelengths that nobody stated
_EVALUATIONS = 1_000_000_000  # of a term, for an estimate of what was generated
CURVE_POINTS = 400  # of a spectrum's formula


@dataclass(frozen=True)
class Described:
    """What is known of a study's irregularity before anything runs."""

    study: Study
    #: Of its runs.
    profile: irr.Profile
    #: A measured level of the study as it is and band-passed; nothing without one.
    measured: tuple[irr.MeasuredProfile, ...]
    #: For the user, e.g. that the profile repeats itself.
    warnings: tuple[str, ...]

    @cached_property
    def files(self) -> dict[str, str]:
        """Name of each file -> SHA-256 of its content."""
        table = self.study.irregularity
        names = [table.measured_file] if self.measured else []
        if isinstance(table.wheel_defect, irr.DepthMap):
            names.append(table.wheel_defect.file)
        return {Path(name).name: content_digest(name) for name in names}

    @cached_property
    def info(self) -> IrregularityInfo:
        """What Fig. 1 shows."""
        table = self.study.irregularity
        smooth = isinstance(self.profile, irr.SmoothRail)
        formula = table.generated or table.spectrum == "measured"
        measured, level = _measured_info(table, *self.measured) if self.measured else (None, None)
        return IrregularityInfo(
            spectrum=_curve(table) if formula else None,
            estimate=_estimate(table, irr.even(self.profile)) if table.generated else None,
            profile=None if smooth else sampled(self.study, self.profile),
            measured=measured if measured and np.any(measured.density) else None,
            measured_profile=level,
        )


def irregularity_of(study: Study, smooth: bool = False, direction: Direction = "Z") -> irr.Profile:
    """The profile of a study's runs.

    None of it for a run that asks for a smooth rail; in direction Y the seed's independent
    transverse profile.

    Raises
    ------
    InputError
        When a measured file cannot be used or does not cover the journey.
    """
    if smooth:
        return irr.SmoothRail()
    required = (study.journey.start, study.journey.end) if study.runs else None
    if required and study.track.structure is not None:
        required = 0.0, study.track.length  # wheels come from the ground before it
    touch = 0.0
    if study.irregularity.wheel_defect is not None and not study.solid.half:
        placed = geometry(study)
        touch = float(placed.wheel.point(placed.touch.wheel_s)[0])
    return study.irregularity.profile(direction, required, study.vehicle.wheel_radius, touch)


def irregularity_of_rails(study: Study, smooth: bool = False) -> irr.RailProfiles:
    """The profiles of both rails of a bridge, vertical and transverse."""
    if smooth:
        return irr.RailProfiles(irr.SmoothRail(), irr.SmoothRail())
    required = (0.0, study.track.length) if study.runs else None
    return irr.both_rails(study.irregularity, required, study.vehicle.wheel_radius)


def sharpness(study: Study) -> float:
    """Curvature of a sinusoid's troughs over the wheel's, k^2 A R; 0 for another irregularity."""
    table = study.irregularity
    if table.spectrum != "sinusoid":
        return 0.0
    return (2.0 * np.pi / table.wavelength) ** 2 * table.amplitude * study.vehicle.wheel_radius


def too_sharp(study: Study) -> str:
    """What is wrong with waves that a wheel cannot follow, "" for those that it can."""
    if sharpness(study) <= 1.0:
        return ""
    return (
        "the troughs of the wave are sharper than the wheel ((2π/λ)² times amplitude and radius is "
        "above 1), which would rest on two crests"
    )


def describe(study: Study) -> Described:
    """Read the study's irregularity.

    Raises
    ------
    InputError
        When a measured file cannot be used or does not cover the journey.
    """
    table, measured = study.irregularity, tuple[irr.MeasuredProfile, ...]()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        profile = irregularity_of(study)
        irr.check_repeat(profile, study.journey.end - study.journey.start)
    if table.measured_file:
        measured = table.measured(None), table.measured(table.wavelengths)
    notes = [str(w.message) for w in caught]
    if measured:
        notes.append(_left_out(table, *measured))
        notes += doubtful(measured[0], table.wavelengths)
        if table.spectrum == "measured":
            notes += _unsettled(study, measured[1])
    elif isinstance(profile, irr.HarmonicProfile) and not profile.amplitudes.any():
        notes.append("the irregularity is zero throughout: the rail is smooth")
    notes += [f"irregularity: {text}"] if (text := too_sharp(study)) else []
    if isinstance(worn := table.wheel_defect, irr.DepthMap):
        notes += doubtful_map(Path(worn.file), worn.read, study.vehicle.wheel_radius)
    described = Described(study, profile, measured, tuple(notes))
    if measured:
        _ = described.info  # a level too short for an estimate is refused here
    return described


def _left_out(table: irr.Irregularity, raw: irr.MeasuredProfile, kept: irr.MeasuredProfile) -> str:
    """How much of a record's variance about its trend the band-pass leaves out.

    ``InputError`` where the default wavelengths would drop most of it without a word.
    """
    about = raw.levels - np.polyval(np.polyfit(raw.positions, raw.levels, 1), raw.positions)
    name, variance = Path(table.measured_file).name, float(np.var(about))
    if variance == 0.0:
        return f"{name}: the level is zero throughout: the rail is smooth"
    share = min(max(1.0 - float(np.var(kept.levels)) / variance, 0.0), 1.0)
    low, high = table.wavelengths
    text = f"{low:g} to {high:g} m leave out {100 * share:.3g} % of the variance of {name}"
    if share > MOST_LEFT_OUT and not table.given("wavelengths"):
        raise InputError(
            f"irregularity.wavelengths: the default of {text}; state the shortest and the longest "
            "wavelength that the measurement is valid for"
        )
    return f"wavelengths of {text}"


def _unsettled(study: Study, profile: irr.MeasuredProfile) -> list[str]:
    """Warning of a journey over what the band-pass has not settled on."""
    (low, high), journey = profile.sound, study.journey
    if not study.runs or (low <= journey.start and journey.end <= high):
        return []
    part = f"only X = {low:.4g} to {high:.4g} m" if low < high else "nothing"
    return [
        f"{Path(profile.name).name}: of X = {profile.domain[0]:.4g} to {profile.domain[1]:.4g} m "
        f"{part} is sound, because the band-pass needs the longest wavelength on either side to "
        f"settle; the journey goes from {journey.start:g} to {journey.end:g} m"
    ]


def _curve(table: irr.Irregularity) -> SpectrumCurve:
    omega = np.geomspace(*table.band, CURVE_POINTS)
    formula = table.formula()
    density = formula(omega)
    table_1 = np.array_equal(density, irr.paper_spectrum()(omega))
    label = "eq. (3), Table 1" if table_1 else formula.name
    return SpectrumCurve(label, omega, density, table.band)


def _estimate(table: irr.Irregularity, profile: irr.Profile) -> SpectrumCurve:
    """Welch's estimate over two repeat lengths of the profile, in the band of its terms.

    The 36 m of the track are half a wavelength of the longest term; a profile is a function of
    X, so a long stretch of the same one can be had.
    """
    low, high = table.band
    step = np.pi / (2.5 * high)
    length = max(4.0 * np.pi * table.terms / (high - low), 400 * step)
    length = min(length, max(_EVALUATIONS // table.terms, 400) * step)
    values = profile(np.arange(0.0, length, step))
    estimate = irr.spectral_estimate(values, step)
    inside = (estimate.wavenumber >= low) & (estimate.wavenumber <= high)
    label = f"generated profile, seed {table.seed}"
    return SpectrumCurve(label, estimate.wavenumber[inside], estimate.density[inside], table.band)


def _measured_info(
    table: irr.Irregularity, raw: irr.MeasuredProfile, passed: irr.MeasuredProfile
) -> tuple[SpectrumCurve, Level]:
    """Spectrum of the level as measured, with its valid band, and the band-passed level."""
    step = float(np.median(np.diff(raw.positions)))
    even = np.arange(raw.domain[0], raw.domain[1], step)
    estimate = irr.spectral_estimate(raw(even), step)
    band = 2.0 * np.pi / table.wavelengths[1], 2.0 * np.pi / table.wavelengths[0]
    label = f"measured level ({Path(table.measured_file).name}, {table.level_column})"
    positive = estimate.wavenumber > 0.0
    spectrum = SpectrumCurve(label, estimate.wavenumber[positive], estimate.density[positive], band)
    return spectrum, Level(label, passed.positions, passed.levels)
