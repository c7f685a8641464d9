"""What Figs 1a and 1b show of an irregularity, and its labelled dataset."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from contactstudy.arrays import Array

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class SpectrumCurve:
    """Samples of a power spectral density of the vertical irregularity.

    Angular wavenumber (n,) in rad/m, increasing; two-sided density G (n,) in m^2/(rad/m): the
    variance is 2 * int_0^inf G dω. It is valid within ``band``, in rad/m.
    """

    label: str
    wavenumber: Array
    density: Array
    band: tuple[float, float]


@dataclass(frozen=True)
class Level:
    """A profile over position: ``position`` (n,) in m and ``level`` (n,) in m, up positive.

    `deviations` says its standard deviation in the bands of EN 13848 where it is generated.
    """

    label: str
    position: Array
    level: Array
    deviations: str = ""


@dataclass(frozen=True)
class IrregularityInfo:
    """Everything Figs 1a and 1b show.

    Attributes
    ----------
    spectrum
        The formula, e.g. eq. (3); None when the study's irregularity is a measured profile.
    estimate
        Of the profile in use; None for a smooth rail.
    profile
        The profile in use over the track (before it is faded in).
    measured, measured_profile
        Spectral estimate of a measured profile, and its level, band-passed.
    """

    spectrum: SpectrumCurve | None = None
    estimate: SpectrumCurve | None = None
    profile: Level | None = None
    measured: SpectrumCurve | None = None
    measured_profile: Level | None = None


_SPECTRA = ("spectrum", "estimate", "measured")
_LEVELS = ("profile", "measured_profile")


def to_dataset(info: IrregularityInfo) -> xr.Dataset:
    """Labelled data that netCDF can hold; each curve with a dimension of its own."""
    import xarray as xr

    data = xr.Dataset()
    for key in _SPECTRA:
        spectrum = getattr(info, key)
        if spectrum is not None:
            k = f"{key}_wavenumber"
            data[k] = (k, spectrum.wavenumber, {"units": "rad/m"})
            attrs = {"units": "m^2/(rad/m)", "sides": "two", "long_name": spectrum.label}
            attrs["valid_band"] = list(spectrum.band)
            data[f"{key}_density"] = (k, spectrum.density, attrs)
    for key in _LEVELS:
        level = getattr(info, key)
        if level is not None:
            x = f"{key}_position"
            data[x] = (x, level.position, {"units": "m"})
            attrs = {"units": "m", "long_name": level.label}
            if level.deviations:
                attrs["standard_deviation"] = level.deviations
            data[key] = (x, level.level, attrs)
    return data


def from_dataset(data: xr.Dataset) -> IrregularityInfo:
    """The inverse of `to_dataset`."""
    parts: dict[str, Any] = {}
    for key in _SPECTRA:
        if f"{key}_density" in data:
            density = data[f"{key}_density"]
            low, high = density.attrs["valid_band"]
            wavenumber, band = data[f"{key}_wavenumber"].values, (float(low), float(high))
            parts[key] = SpectrumCurve(density.attrs["long_name"], wavenumber, density.values, band)
    for key in _LEVELS:
        if key in data:
            attrs, position = data[key].attrs, data[f"{key}_position"].values
            deviations = attrs.get("standard_deviation", "")
            parts[key] = Level(attrs["long_name"], position, data[key].values, deviations)
    return IrregularityInfo(**parts)
