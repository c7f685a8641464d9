"""Fig. 1 of the paper: spectra of the irregularity (a) and its profile (b)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter
from numpy.typing import ArrayLike

from contactstudy.compare.signals import position
from contactstudy.irregularity.shown import IrregularityInfo, Level, SpectrumCurve, from_dataset
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, GREEN, SHADE, VERMILION, new_figure
from contactstudy.plot.text import capital, exact, number
from contactstudy.study.results import StudyResults


def drawings(results: StudyResults) -> list[Drawing]:
    """Figs 1a and 1b, as far as the study has spectra and a profile."""
    info = irregularity_of(results)
    made = []
    if info.spectrum or info.estimate or info.measured:
        made.append(
            Drawing("irregularity_spectrum", _spectrum_caption(info), lambda: _spectra(info))
        )
    if info.profile is not None and np.any(info.profile.level):
        profile = info.profile
        span = within(_travelled(results), profile)
        caption = _profile_caption(profile, span)
        made.append(Drawing("irregularity_profile", caption, lambda: _profile(profile, span)))
    return made


def irregularity_of(results: StudyResults) -> IrregularityInfo:
    """What the results say of the irregularity."""
    data = results.groups.get("irregularity")
    return IrregularityInfo() if data is None else from_dataset(data)


def density_at(spectrum: SpectrumCurve, wavenumber: np.ndarray) -> np.ndarray:
    """Density of `spectrum` at `wavenumber` (n,) in rad/m, interpolated on logarithmic axes."""
    keep = (spectrum.wavenumber > 0) & (spectrum.density > 0)
    x, y = np.log(spectrum.wavenumber[keep]), np.log(spectrum.density[keep])
    return np.exp(np.interp(np.log(wavenumber), x, y))


def mean_level_difference(one: SpectrumCurve, other: SpectrumCurve) -> tuple[float, float, float]:
    """Mean of 10 lg(one/other) in dB over the logarithm of the wavenumber, and the band [rad/m].

    The band is what both spectra cover and declare valid; nan when there is none.
    """
    low = max(one.band[0], other.band[0], _lowest(one), _lowest(other))
    high = min(one.band[1], other.band[1], one.wavenumber[-1], other.wavenumber[-1])
    if not low < high:
        return float("nan"), float("nan"), float("nan")
    at = np.geomspace(low, high, 200)
    ratio = density_at(one, at) / density_at(other, at)
    return float(np.mean(10 * np.log10(ratio))), float(low), float(high)


def comparisons(info: IrregularityInfo) -> list[str]:
    """Sentences that say how far estimate and measurement lie from the formula, on average."""
    sentences = []
    for other in (info.estimate, info.measured):
        if info.spectrum is None or other is None:
            continue
        mean, low, high = mean_level_difference(other, info.spectrum)
        if np.isfinite(mean):
            side = "above" if mean > 0 else "below"
            sentences.append(
                f"On average over {exact(low, 3)} to {exact(high, 3)} rad/m “{other.label}” lies "
                f"{number(abs(mean), 2)} dB {side} “{info.spectrum.label}”."
            )
    return sentences


def _lowest(spectrum: SpectrumCurve) -> float:
    return float(spectrum.wavenumber[spectrum.wavenumber > 0][0])


def _spectrum_caption(info: IrregularityInfo) -> str:
    text = (
        "Power spectral density of the vertical irregularity, two-sided over the angular "
        "wavenumber: the variance is the integral over both signs."
    )
    text += "".join(f" {sentence}" for sentence in comparisons(info))
    if info.measured is not None:
        low, high = info.measured.band
        text += (
            f" The measurement is valid in the shaded band of {exact(low, 3)} to "
            f"{exact(high, 3)} rad/m (wavelengths of {number(2 * np.pi / high)} to "
            f"{number(2 * np.pi / low)} m); outside it is drawn thin."
        )
    return text


def _spectra(info: IrregularityInfo) -> Figure:
    figure = new_figure(3.6)
    axes = figure.add_subplot()
    if info.measured is not None:
        axes.axvspan(*info.measured.band, color=SHADE, lw=0, zorder=0)
        _line(axes, info.measured, GREEN, (0, (4, 1.5, 1, 1.5)), 1.2)
    if info.estimate is not None:
        _line(axes, info.estimate, BLUE, "-", 0.8)
    if info.spectrum is not None:
        _line(axes, info.spectrum, VERMILION if info.estimate is None else BLACK, "--", 1.4)
    axes.set(xscale="log", yscale="log", xlabel="Angular wavenumber ω (rad/m)")
    axes.set_ylabel("PSD $G_{rr}$, two-sided (m²/(rad/m))", parse_math=True)
    _limits(axes, info)
    second = axes.secondary_xaxis("top", functions=(_reciprocal, _reciprocal))
    second.set_xlabel("Wavelength (m)")
    for axis in (axes.xaxis, second.xaxis):
        axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axes.legend(loc="lower left")
    return figure


def _reciprocal(x: ArrayLike) -> ArrayLike:
    x = np.asarray(x, dtype=float)
    return 2 * np.pi / np.where(x > 0, x, np.inf)


def _line(axes: Axes, spectrum: SpectrumCurve, color: str, dashes: object, width: float) -> None:
    x, y = spectrum.wavenumber, spectrum.density
    valid = (x >= spectrum.band[0]) & (x <= spectrum.band[1])
    axes.plot(x, np.where(y > 0, y, np.nan), color=color, lw=0.4 * width, alpha=0.7)
    inside = np.where(valid & (y > 0), y, np.nan)
    axes.plot(x, inside, color=color, ls=dashes, lw=width, label=capital(spectrum.label))


def _limits(axes: Axes, info: IrregularityInfo) -> None:
    """Show the bands that are declared valid with a margin, not the tails that leak out of them."""
    shown = [s for s in (info.spectrum, info.estimate, info.measured) if s is not None]
    low = min(max(s.band[0], _lowest(s)) for s in shown)
    high = max(min(s.band[1], s.wavenumber[-1]) for s in shown)
    inside = [(s.wavenumber >= s.band[0]) & (s.wavenumber <= s.band[1]) for s in shown]
    found = np.concatenate(
        [s.density[k & (s.density > 0)] for s, k in zip(shown, inside, strict=True)]
    )
    axes.set_xlim(low / 1.3, high * 1.3)
    axes.set_ylim(max(found.min(), 1e-16 * found.max()) / 3, found.max() * 3)


def _travelled(results: StudyResults) -> tuple[float, float] | None:
    spans = [position(run)[[0, -1]] for run in results.runs.values()]
    if not spans:
        return None
    return min(float(s[0]) for s in spans), max(float(s[1]) for s in spans)


def within(span: tuple[float, float] | None, profile: Level) -> tuple[float, float] | None:
    """The part of a stretch that has a profile, None where it is all: a train runs on behind it."""
    low, high = (float(x) for x in profile.position[[0, -1]])
    if span is None or (span[0] <= low and span[1] >= high):
        return None
    return max(span[0], low), min(span[1], high)


def _profile_caption(profile: Level, travelled: tuple[float, float] | None) -> str:
    r = profile.level * 1e3
    text = (
        f"Vertical irregularity of the track ({profile.label}), positive upwards: from "
        f"{number(r.min())} to {number(r.max())} mm, "
        f"root mean square {number(float(np.std(r)))} mm."
    )
    if profile.deviations:
        text += f" Standard deviation in the bands of EN 13848: {profile.deviations}."
    if travelled is not None:
        text += (
            f" The shaded stretch from {exact(travelled[0])} to {exact(travelled[1])} m is "
            "what the wheel runs over."
        )
    return text


def _profile(profile: Level, travelled: tuple[float, float] | None) -> Figure:
    figure = new_figure(2.2)
    axes = figure.add_subplot()
    if travelled is not None:
        axes.axvspan(*travelled, color=SHADE, lw=0, zorder=0)
    axes.plot(profile.position, profile.level * 1e3, color=BLUE, lw=0.8)
    axes.axhline(0.0, color=BLACK, lw=0.4)
    axes.set_xlabel("Position X along the rail (m)")
    axes.set_ylabel("Irregularity $r_v$ (mm)", parse_math=True)
    axes.margins(x=0)
    return figure
