"""The irregularity of a study: generated from a spectrum, a sinusoid, measured, or none."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from contactstudy.irregularity.defective import with_defects
from contactstudy.irregularity.flats import WheelDefect
from contactstudy.irregularity.measured import Interpolation, MeasuredProfile, measured_profile
from contactstudy.irregularity.profile import HarmonicProfile, Profile, SmoothRail
from contactstudy.irregularity.psd import Spectrum
from contactstudy.irregularity.rail_defects import RAIL_DEFECTS, RailDefect
from contactstudy.irregularity.sample import sample_profile
from contactstudy.irregularity.spectra import NAMES, paper_spectrum, spectrum
from contactstudy.irregularity.wheel_defects import WHEEL_DEFECTS
from contactstudy.validation import (
    Above,
    AtLeast,
    AtMost,
    By,
    File,
    Naming,
    Parameters,
    Unit,
    Usual,
    When,
    asked,
    by,
    complaint,
)
from contactstudy.validation import quantities as q

_PAPER = When("spectrum", "paper")
_GENERATED = When("spectrum", *NAMES)
_MEASURED = When("spectrum", "measured")
_SINUSOID = When("spectrum", "sinusoid")
# how a CSV file is read
_CSV = (
    "x_column", "level_column", "left_column", "lateral_column", "left_lateral_column",
    "level_unit", "origin", "wavelengths", "interpolation", "measured_overlay",
)  # fmt: skip


@dataclass(frozen=True)
class Irregularity(Parameters):
    """Vertical level of the running surface, up positive; `profile` is what the solvers take.

    Defects come on top of it, and are not faded in, but for a wheel that is not round.
    """

    spectrum: Annotated[
        Literal[
            "paper", "german_low", "german_high", "fra1", "fra2", "fra3", "fra4", "fra5", "fra6",
            "tbt3352", "sinusoid", "measured", "smooth",
        ],
        "formula that the profile is generated from, or a sinusoid, a measured or a smooth one",
    ] = "paper"  # fmt: skip
    sides: Annotated[
        Literal["one", "two"],
        By("spectrum", **{name: spectrum(name).convention.sides for name in NAMES}),
        _GENERATED,
        "how the formula is read: its variance is the integral over one or both signs",
    ] = by()
    roughness: Annotated[
        float, Unit("m^2*rad/m"), Above(0), Usual(1e-10, 1e-5), _PAPER, "A_r of eq. (3)"
    ] = 0.8e-7  # fmt: skip
    omega_1: Annotated[float, Unit("rad/m"), AtLeast(0), _PAPER, "of eq. (3)"] = 0.0
    omega_2: Annotated[q.Wavenumber, _PAPER, "of eq. (3)"] = 1.0
    seed: Annotated[q.CountOrZero, _GENERATED, "of the random phases"] = 1
    terms: Annotated[q.Count, AtMost(100_000), _GENERATED, "number of terms N of eq. (1)"] = 1000
    band: Annotated[
        tuple[float, float], Unit("rad/m"), Above(0), _GENERATED, "lowest and highest wavenumber"
    ] = (0.08, 20.0)
    jitter: Annotated[
        bool, _GENERATED, "wavenumbers at random in their intervals: nothing repeats itself"
    ] = False
    coherence: Annotated[
        float | Literal["decaying"], AtLeast(0), AtMost(1), _GENERATED,
        "gamma^2 of the two rails, on a track with both: 1 alike, 0 independent, or exp(-l/lambda)",
    ] = 1.0  # fmt: skip
    coherence_wavelength: Annotated[
        q.Length, When("coherence", "decaying"), "l, where it is 1/e"
    ] = 3.0  # fmt: skip
    wavelength: Annotated[
        q.Length, Usual(1e-3, 500.0), _SINUSOID, "of r = amplitude cos(2 pi X/wavelength + phase)"
    ] = 1.0
    amplitude: Annotated[
        q.LengthOrZero, Usual(1e-9, 0.05), _SINUSOID, "half the height from trough to crest"
    ] = 1e-5
    phase: Annotated[float, Unit("rad"), _SINUSOID, "at X = 0"] = 0.0
    file: Annotated[str, File(), _MEASURED, "CSV file with the measured level"] = ""
    measured_overlay: Annotated[
        str,
        File(),
        When("spectrum", *NAMES, "sinusoid", "smooth"),
        "CSV file that is drawn beside it",
    ] = ""
    x_column: Annotated[str, "column of the CSV file with the position in m"] = "x"
    level_column: Annotated[str, "column with the level, up positive"] = ""
    left_column: Annotated[
        str,
        _MEASURED,
        "column with the left rail's level, on a track with both; as the right's if left out",
    ] = ""  # fmt: skip
    lateral_column: Annotated[
        str,
        _MEASURED,
        "column with the right rail's alignment, to the left positive; none if left out",
    ] = ""  # fmt: skip
    left_lateral_column: Annotated[
        str, _MEASURED, "column with the left rail's alignment; as the right's if left out"
    ] = ""  # fmt: skip
    level_unit: Annotated[Literal["mm", "m", "um", "µm"], "its unit"] = "mm"
    origin: Annotated[q.Position, _MEASURED, "position in the file that is X = 0"] = 0.0
    wavelengths: Annotated[
        tuple[float, float], Unit("m"), Above(0), "shortest and longest wavelength that is kept"
    ] = (2.5, 42.0)
    interpolation: Annotated[Interpolation, _MEASURED, "between the positions"] = "cubic"
    rail_defect: Annotated[RailDefect | None, RAIL_DEFECTS] = None
    wheel_defect: Annotated[WheelDefect | None, WHEEL_DEFECTS] = None

    def problems(self, key: Naming) -> Iterator[str]:
        """Ranges that fall, and a measured level without file or column."""
        for name, unit in (("band", "rad/m"), ("wavelengths", "m")):
            yield from asked(self._falls, key(name), name, unit)
        if self.spectrum == "measured" and not self.file:
            yield (
                f"{key('file')}: is missing; a measured irregularity needs a CSV file "
                "(--set irregularity.file=PATH)"
            )
        if self.measured_file and self.level_column == self.x_column:
            allowed = f"must be another column than {key('x_column')}"
            yield complaint(key("level_column"), self.level_column, allowed)
        if self.measured_file and not self.level_column:
            yield f"{key('level_column')}: is missing; name the column of the CSV with the level"

    def _falls(self, key: str, name: str, unit: str) -> Iterator[str]:
        low, high = getattr(self, name)
        if not low < high:
            yield complaint(key, [low, high], f"must increase, lowest first ({unit})")

    @property
    def measured_file(self) -> str:
        """The CSV file in use or to be drawn beside, "" for none."""
        return self.file if self.spectrum == "measured" else self.measured_overlay

    @property
    def defects(self) -> tuple[str, str]:
        """Names of the defects of rail and wheel."""
        return RAIL_DEFECTS.name(self.rail_defect), WHEEL_DEFECTS.name(self.wheel_defect)

    @property
    def generated(self) -> bool:
        """Whether the profile is made from a spectrum."""
        return self.spectrum in NAMES

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value; how to read a CSV is left out where none is named."""
        values = super().resolved()
        return values if self.measured_file else {k: values[k] for k in values if k not in _CSV}

    def formula(self, direction: Literal["Z", "Y"] = "Z") -> Spectrum:
        """The spectrum that is generated from; Table 1's where nothing is generated.

        The paper has one formula for both directions.
        """
        if not self.generated:
            return paper_spectrum()
        if self.spectrum == "paper":
            found = paper_spectrum(self.roughness, self.omega_1, self.omega_2)
        else:
            found = spectrum(self.spectrum, direction="vertical" if direction == "Z" else "lateral")
        return found.read(self.sides)

    def profile(
        self,
        direction: Literal["Z", "Y"] = "Z",
        required: tuple[float, float] | None = None,
        radius: float = 0.43,
        touch: float = 0.0,
    ) -> Profile:
        """The profile, as a function of X.

        In direction "Y" it is the seed's independent transverse one, from the spectrum's lateral
        formula if it has one, without defects.

        Parameters
        ----------
        radius : float
            Of the wheel that has a defect [m].
        touch : float
            Where it touches the rail, y on its profile [m].

        Raises
        ------
        InputError
            When a measured file cannot be used or does not cover the required range of X [m], or
            when a depth map cannot be used.
        """
        even = self._even(direction, required)
        if direction == "Y" or not (self.rail_defect or self.wheel_defect):
            return even
        return with_defects(even, self.rail_defect, self.wheel_defect, radius, touch)

    def _even(self, direction: Literal["Z", "Y"], required: tuple[float, float] | None) -> Profile:
        """The profile without defects."""
        if self.spectrum == "smooth":
            return SmoothRail()
        if self.spectrum == "sinusoid":
            return HarmonicProfile.wave(self.amplitude, self.wavelength, self.phase)
        if self.spectrum == "measured":
            return self.measured(self.wavelengths, required)
        which: Literal["vertical", "transverse"] = "vertical" if direction == "Z" else "transverse"
        formula = self.formula(direction)
        return sample_profile(formula, self.seed, self.terms, self.band, self.jitter, which)

    def measured(
        self, wavelengths: tuple[float, float] | None, required: tuple[float, float] | None = None
    ) -> MeasuredProfile:
        """The level of `measured_file`, with the wavelengths that are kept; None: all of them."""
        return measured_profile(
            Path(self.measured_file),
            self.level_column,
            self.level_unit,
            x_column=self.x_column,
            origin=self.origin if self.spectrum == "measured" else 0.0,
            wavelengths=wavelengths,
            interpolation=self.interpolation,
            required=required,
        )
