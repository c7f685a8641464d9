"""Static press of the wheel on the rail: force over approach, and what Hertz has of it."""

from functools import partial

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.hertz_ellipse import hertz_patch
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, VERMILION, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

_HERTZ = 1.5
"""Exponent of Hertz's law; bodies that also give linearly have a smaller one."""


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for the first run that carries a static press, else none."""
    for name, run in results.runs.items():
        if "press_force" in run and "press_approach" in run:
            force, approach, hertz = curves(results, run)
            caption = _caption(name, force, approach, hertz)
            return [Drawing("static_press", caption, partial(_draw, force, approach, hertz))]
    return []


def curves(results: StudyResults, run: xr.Dataset) -> tuple[Array, Array, Array | None]:
    """Forces (k,) in N, approaches (k,) in m, and Hertz's approaches (k,) or None without radii."""
    force = np.asarray(run["press_force"].values, dtype=float)
    approach = np.asarray(run["press_approach"].values, dtype=float)
    patches = [hertz_patch(results, float(f)) for f in force]
    hertz = [p.approach for p in patches if p is not None]
    return force, approach, np.array(hertz) if len(hertz) == len(force) else None


def exponent(force: Array, approach: Array) -> float:
    """Slope of lg force over lg approach: 1.5 by Hertz."""
    return float(np.polyfit(np.log(approach), np.log(force), 1)[0])


def power_law(force: Array, approach: Array, at: Array) -> Array:
    """Force (n,) in N of the power law through all points, at approaches (n,) in m."""
    found: Array = np.exp(np.polyval(np.polyfit(np.log(approach), np.log(force), 1), np.log(at)))
    return found


def own_give(force: Array, approach: Array, hertz: Array) -> float:
    """Linear flexibility c [m/N] of the bodies beside the contact, by least squares.

    ``approach = hertz + c F``: the wheel between hub and tread, the rail between head and centre
    line.
    """
    return float(force @ (approach - hertz) / (force @ force))


def _draw(force: Array, approach: Array, hertz: Array | None) -> Figure:
    figure = new_figure(2.6, 4.2)
    axes = figure.add_subplot()
    text = "meshed bodies, hub to centre line"
    axes.plot(approach * 1e6, force * 1e-3, "o", color=BLACK, ms=4, label=text)
    if hertz is not None:
        # both from hub to centre line: the contact alone would be another quantity
        text = "Hertz and a linear give of the bodies, fitted"
        both = hertz + own_give(force, approach, hertz) * force
        axes.plot(both * 1e6, force * 1e-3, color=VERMILION, ls="--", label=text)
    else:
        text = "power law, fitted"
        x = np.linspace(approach.min(), approach.max(), 100)
        axes.plot(x * 1e6, power_law(force, approach, x) * 1e-3, color=VERMILION, ls="--",
                  label=text)  # fmt: skip
    axes.set(xlabel="Approach (µm)", ylabel="Force (kN)")
    axes.legend(loc="upper left")
    return figure


def _caption(name: str, force: Array, approach: Array, hertz: Array | None) -> str:
    text = (
        f"Static press of the wheel on the rail of the run {label(name)}: force over the approach "
        "of the wheel's hub to the rail's centre line. "
        f"Fitted exponent {number(exponent(force, approach), 4)}."
    )
    if hertz is None and exponent(force, approach) > _HERTZ:
        text += " It is above Hertz's 1.5: more comes into contact as the load grows."
    if hertz is not None:
        k, give = len(force) // 2, own_give(force, approach, hertz)
        left = float(np.abs(approach - hertz - give * force).max())
        text += (
            f" Hertz's law of the contact (exponent 1.5) and a linear give of "
            f"{number(give * 1e12)} µm/MN reproduce it within {number(left * 1e6, 2)} µm. Hertz "
            f"accounts for {number(hertz[k] * 1e6)} of the {number(approach[k] * 1e6)} µm at "
            f"{number(force[k] * 1e-3)} kN."
        )
    return text
