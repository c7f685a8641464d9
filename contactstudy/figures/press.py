"""Static press of the wheel on the rail: force over approach against Hertz."""

import numpy as np
from matplotlib.figure import Figure

from contactstudy.figures.drawing import Drawing, FloatArray, label, number
from contactstudy.figures.style import BLACK, VERMILION, new_figure
from contactstudy.study.results import StudyResults


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for the first run that carries a static press, else none."""
    for name, run in results.runs.items():
        if "press_force" in run and "press_approach" in run:
            force = np.asarray(run["press_force"].values, dtype=float)
            approach = np.asarray(run["press_approach"].values, dtype=float)
            hertz = (
                np.asarray(run["press_hertz_approach"].values, dtype=float)
                if "press_hertz_approach" in run
                else None
            )
            return [
                Drawing(
                    "static_press",
                    _caption(name, force, approach, hertz),
                    lambda f=force, a=approach, h=hertz: _draw(f, a, h),  # type: ignore[misc]
                )
            ]
    return []


def exponent(force: FloatArray, approach: FloatArray) -> float:
    """Slope of lg force over lg approach: 1.5 by Hertz."""
    return float(np.polyfit(np.log(approach), np.log(force), 1)[0])


def _draw(force: FloatArray, approach: FloatArray, hertz: FloatArray | None) -> Figure:
    figure = new_figure(2.8, 4.2)
    axes = figure.add_subplot()
    if hertz is not None:
        axes.plot(hertz * 1e6, force * 1e-3, color=VERMILION, ls="--", label="Hertz")
    axes.plot(approach * 1e6, force * 1e-3, "o", color=BLACK, ms=4, label="static press, meshed")
    axes.set_xlabel("Approach (µm)")
    axes.set_ylabel("Force (kN)")
    axes.legend(loc="upper left")
    return figure


def _caption(name: str, force: FloatArray, approach: FloatArray, hertz: FloatArray | None) -> str:
    text = (
        f"Static press of the geometry of the run {label(name)}, far field removed: force over "
        f"approach. Fitted exponent {number(exponent(force, approach), 4)} (Hertz 1.5)."
    )
    if hertz is not None:
        error = 100 * (approach / hertz - 1)
        text += f" The approach differs from Hertz's by at most {number(np.abs(error).max(), 2)} %."
    return text
