"""How the deck of a bridge moves at the station where it moves most."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from contactstudy.figures.signals import styles
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

STATIC = "static loads"


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure where all runs recorded a deck."""
    station = largest_station(results)
    if station is None:
        return []
    return [Drawing("deck_motion", _caption(results, station), partial(_draw, results, station))]


def largest_station(results: StudyResults) -> float | None:
    """Station [m] at which a deck moves most in any run; None if not all recorded one."""
    best: tuple[float, float] | None = None
    if not all("deck_displacement" in run for run in results.runs.values()):
        return None
    for run in results.runs.values():
        most = np.abs(run["deck_displacement"].values).max(axis=1)
        for x, value in zip(run["station"].values, most, strict=True):
            if np.isfinite(value) and (best is None or value > best[0]):
                best = float(value), float(x)
    return None if best is None else best[1]


def _draw(results: StudyResults, station: float) -> Figure:
    figure = new_figure(3.4)
    above, below = figure.subplots(2, 1, sharex=True)
    for name, style in styles(results).items():
        run = results.runs[name].sel(station=station)
        time = run["time"].values
        above.plot(time, 1e3 * run["deck_displacement"].values, label=label(name), **style.line)
        below.plot(time, run["deck_acceleration"].values, **style.line)
    first = next(iter(results.runs.values())).sel(station=station)
    above.plot(
        first["time"].values,
        1e3 * first["deck_static"].values,
        color=BLACK,
        lw=0.7,
        ls=(0, (4, 2)),
        label=STATIC,
    )
    above.set_ylabel("Displacement\n(mm)")
    below.set_ylabel("Acceleration\n(m/s²)")
    below.set_xlabel("Time (s)")
    below.margins(x=0)
    figure.align_ylabels()
    figure_legend(figure, above)
    return figure


def _caption(results: StudyResults, station: float) -> str:
    told = []
    for name, run in results.runs.items():
        here = run.sel(station=station)
        down = 1e3 * float(np.abs(here["deck_displacement"]).max())
        rate = float(np.abs(here["deck_acceleration"]).max())
        told.append(f"{label(name)} {number(down, 3)} mm and {number(rate, 2)} m/s²")
    return (
        f"Displacement and acceleration of the deck's axis at X = {number(station, 4)} m. Dashed: "
        "what the static wheel loads of the first run alone would do. Largest values: "
        f"{'; '.join(told)}."
    )
