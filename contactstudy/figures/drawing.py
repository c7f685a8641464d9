"""What a figure is before it is drawn, and how signals are taken from the labelled results."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare import norms as errors
from contactstudy.figures.style import LineStyle, run_styles
from contactstudy.study.results import StudyResults


@dataclass(frozen=True)
class Drawing:
    """A figure that these results can fill.

    Attributes
    ----------
    name : str
        File name without ending.
    caption : str
        Plain text that says what is drawn and, in numbers taken from the data, what is seen.
    draw : callable
        Makes the figure; to be called within `contactstudy.figures.style.drawing`.
    """

    name: str
    caption: str
    draw: Callable[[], Figure]


@dataclass(frozen=True)
class Signal:
    """How a signal of the results is shown.

    Attributes
    ----------
    name : str
        Variable of the dataset.
    label : str
        What stands in captions and tables.
    axis : str
        What stands on the axis.
    unit : str
        Unit shown.
    scale : float
        Shown value = scale * SI value.
    """

    name: str
    label: str
    axis: str
    unit: str
    scale: float


SIGNALS = (
    Signal("contact_force", "Contact force", "Force", "kN", 1e-3),
    Signal("wheel_displacement", "Wheel displacement", "Displacement", "mm", 1e3),
    Signal("wheel_acceleration", "Wheel acceleration", "Acceleration", "m/s²", 1.0),
    Signal("rail_displacement", "Rail displacement at the wheel", "Displacement", "mm", 1e3),
)


def label(name: str) -> str:
    """Name of a run as it is printed."""
    return name.replace("_", " ")


def styles(results: StudyResults) -> dict[str, LineStyle]:
    """Line style of each run of a study."""
    return run_styles(list(results.runs), results.reference)


def position(run: xr.Dataset) -> Array:
    """Position (time,) of the leading wheel along the track in m."""
    return _leading(run["position"])


def values(run: xr.Dataset, name: str) -> Array:
    """Variable `name` (time,) of the leading wheel in SI units."""
    return _leading(run[name])


def has_signal(run: xr.Dataset, name: str) -> bool:
    """Whether the run carries the signal over time."""
    return name in run and "time" in run[name].dims


def fade_end(results: StudyResults) -> float:
    """Position in m from which the irregularity acts in full; the start when nothing fades."""
    start = min(float(position(run)[0]) for run in results.runs.values())
    journey = results.config.get("journey", {})
    return start + float(journey.get("fade_in", 0.0))


def speed(run: xr.Dataset) -> float:
    """Speed of the run in m/s."""
    x, t = position(run), run["time"].values
    return float((x[-1] - x[0]) / (t[-1] - t[0]))


def compared(
    results: StudyResults, name: str, signal: str, start: float = -np.inf
) -> tuple[Array, Array, Array]:
    """Return positions (k,) in m, the reference's signal (k,) there, and that of the run `name`.

    Taken as the norms take them: at equal positions of the leading wheel, from `start` [m] on.
    """
    reference, run = results.runs[str(results.reference)], results.runs[name]
    x_reference, x_run = position(reference), position(run)
    x = errors.common_positions(x_run, x_reference, start)
    return (
        x,
        errors.at_positions(values(reference, signal), x_reference, x),
        errors.at_positions(values(run, signal), x_run, x),
    )


def _leading(data: xr.DataArray) -> Array:
    if "wheel" in data.dims:
        data = data.isel(wheel=0)
    return np.asarray(data.values, dtype=np.float64)


def wheel_note(results: StudyResults) -> str:
    """Return a sentence that names the wheel when there are several, else nothing."""
    several = any("wheel" in run["position"].dims for run in results.runs.values())
    return " Of several wheels the leading one is shown." if several else ""


def capital(text: str) -> str:
    """`text` with its first letter as a capital."""
    return text[:1].upper() + text[1:]


def number(value: float, digits: int = 3) -> str:
    """`value` to `digits` significant digits in plain text with a typographic minus.

    Powers of ten are written out only where the number would have more than six digits before
    the point or more than three zeros behind it.
    """
    if not np.isfinite(value):
        return "not finite"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power = int(exponent)
    if value == 0.0:
        return "0"
    if -4 <= power < 6:
        text = f"{float(f'{value:.{digits - 1}e}'):.{max(digits - 1 - power, 0)}f}"
    else:
        text = f"{mantissa}·10{_superscript(power)}"
    return text.replace("-", "\N{MINUS SIGN}", 1)


def exact(value: float, digits: int = 6) -> str:
    """Return a given (not a computed) value in plain text, without trailing zeros."""
    text = number(value, digits)
    if "·" in text:
        mantissa, power = text.split("·")
        return f"{_trimmed(mantissa)}·{power}"
    return _trimmed(text)


def _trimmed(text: str) -> str:
    return text.rstrip("0").rstrip(".") if "." in text else text


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _superscript(exponent: int) -> str:
    return str(exponent).translate(_SUPERSCRIPTS)
