"""Smooth rail: contact force over a few bays, and its components at the passing wavelengths."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.figures.drawing import (
    Drawing,
    FloatArray,
    exact,
    has_signal,
    label,
    number,
    position,
    styles,
    values,
    wheel_note,
)
from contactstudy.figures.style import BLACK, GREY, figure_legend, new_figure
from contactstudy.passing import passing_amplitude
from contactstudy.study.results import StudyResults

ORDERS = 12  # of the support spacing; contains four elements a bay and six cells of 0.1 m
BAYS_SHOWN = 3


@dataclass(frozen=True)
class Passing:
    """Components of one run's contact force that repeat with the support spacing.

    Attributes
    ----------
    amplitudes : (ORDERS,) array
        Amplitude in N of the component with wavelength spacing/1, spacing/2, ...
    static : float
        Force in the static equilibrium from which the run starts, N.
    window : (2,) tuple of float
        Positions evaluated, m: a whole number of bays.
    """

    amplitudes: FloatArray
    static: float
    window: tuple[float, float]

    def percent(self, order: int) -> float:
        """Amplitude of the component with wavelength spacing/order in % of the static force."""
        return float(100.0 * self.amplitudes[order - 1] / self.static)


def is_smooth(results: StudyResults) -> bool:
    """Whether every run of the study rolls on a rail without irregularity."""
    return bool(results.runs) and all(
        "irregularity" in run and not np.any(run["irregularity"].values)
        for run in results.runs.values()
    )


def spacing(results: StudyResults) -> float | None:
    """Support spacing of the study's track in m; None on a continuous foundation."""
    found = results.config.get("track", {}).get("spacing")  # absent on a Winkler foundation
    return None if found is None else float(found)


def passing(run: xr.Dataset, bay: float) -> Passing | None:
    """Components of the contact force that repeat with the support spacing `bay` [m].

    Taken over the later half of the run, as many whole bays as it holds: the start from rest
    has died out there.

    Returns
    -------
    Passing or None
        None where the run is shorter than four bays.
    """
    x, force = position(run), values(run, "contact_force")
    bays = int((x[-1] - x[0]) / bay / 2 + 1e-9)
    if bays < 2:
        return None
    window = (float(x[-1] - bays * bay), float(x[-1]))
    # One sample more than the window, so that its first end can be interpolated.
    first = max(int(np.searchsorted(x, window[0])) - 1, 0)
    amplitudes = passing_amplitude(x[first:], force[first:], bay, ORDERS, bay)
    return Passing(amplitudes, float(force[0]), window)


def all_passing(results: StudyResults) -> dict[str, Passing]:
    """Components of each run of a smooth study with discrete supports; empty for any other."""
    bay = spacing(results)
    if bay is None or not is_smooth(results):
        return {}
    found = {
        name: passing(run, bay)
        for name, run in results.runs.items()
        if has_signal(run, "contact_force")
    }
    return {name: p for name, p in found.items() if p is not None}


def named_orders(results: StudyResults, name: str) -> dict[int, str]:
    """Return order of the support spacing -> what passes there in the run `name`.

    Sleeper-passing is order 1; element- and cell-passing lie at the number of elements and of
    cells in a bay, where the model has such.
    """
    bay = spacing(results)
    run = results.config.get("runs", {}).get(name, {})
    orders = {1: "sleeper"}
    on_solid = run.get("solver") == "surface" or run.get("rail") == "solid"
    cell = results.config.get("solid", {}).get("cell_length")
    if on_solid and cell and bay:
        orders[round(bay / float(cell))] = "cell"
    elif "elements_per_bay" in run:
        orders[int(run["elements_per_bay"])] = "element"
    return orders


def drawings(results: StudyResults) -> list[Drawing]:
    """Force over a few bays and the amplitudes, for a study on a smooth rail."""
    found = all_passing(results)
    if not found:
        return []
    return [
        Drawing("smooth_force", _force_caption(results, found), lambda: _force(results, found)),
        Drawing("passing_amplitudes", _bars_caption(results, found), lambda: _bars(results, found)),
    ]


def _shown(results: StudyResults, found: dict[str, Passing]) -> tuple[float, float]:
    """Return the last whole bays that all runs pass, from support to support."""
    bay = spacing(results) or 1.0
    end = min(p.window[1] for p in found.values())
    last = np.floor(end / bay + 1e-9) * bay
    return float(last - BAYS_SHOWN * bay), float(last)


def _force(results: StudyResults, found: dict[str, Passing]) -> Figure:
    figure = new_figure(3.0)
    axes = figure.add_subplot()
    low, high = _shown(results, found)
    bay = spacing(results) or 1.0
    for name in found:
        run = results.runs[name]
        x, force = position(run), values(run, "contact_force") * 1e-3
        keep = (x >= low) & (x <= high)
        axes.plot(x[keep], force[keep], label=label(name), **styles(results)[name].line)
    for support in np.arange(low, high + bay / 2, bay):
        axes.axvline(support, color=GREY, lw=0.6, ls=":")
    axes.set_xlabel("Position X of the wheel (m), supports dotted")
    axes.set_ylabel("Contact force (kN)")
    axes.margins(x=0)
    figure_legend(figure, axes)
    return figure


def _force_caption(results: StudyResults, found: dict[str, Passing]) -> str:
    low, high = _shown(results, found)
    text = (
        f"Contact force on the smooth rail from X = {exact(low)} to {exact(high)} m "
        f"({BAYS_SHOWN} bays), all models on the same supports."
    )
    ranges = []
    for name in found:
        run = results.runs[name]
        x, force = position(run), values(run, "contact_force")
        inside = force[(x >= low) & (x <= high)]
        ranges.append((float(np.ptp(inside)), name))
    ranges.sort()
    text += (
        f" Over these bays the force changes by {number(ranges[0][0] * 1e-3)} kN"
        f" ({label(ranges[0][1])})"
    )
    if len(ranges) > 1:
        text += f" to {number(ranges[-1][0] * 1e-3)} kN ({label(ranges[-1][1])})"
    return text + "." + wheel_note(results)


def _bars(results: StudyResults, found: dict[str, Passing]) -> Figure:
    figure = new_figure(3.0)
    axes = figure.add_subplot()
    width = 0.8 / len(found)
    orders = np.arange(1, ORDERS + 1)
    for k, (name, p) in enumerate(found.items()):
        style = styles(results)[name]
        axes.bar(
            orders + (k - (len(found) - 1) / 2) * width,
            100 * p.amplitudes / p.static,
            width,
            color=style.color if style.hatch == "" else "white",
            edgecolor=style.color,
            hatch=style.hatch,
            linewidth=0.6,
            label=label(name),
        )
    axes.axhline(0.1, color=BLACK, lw=0.8, ls="--")
    axes.text(ORDERS + 0.5, 0.1, "0.1 %", ha="right", va="bottom", fontsize=8)
    axes.set_yscale("log")
    largest = 100 * max(float((p.amplitudes / p.static).max()) for p in found.values())
    axes.set_ylim(1e-4, 3 * max(largest, 0.1))
    bay = spacing(results) or 1.0
    axes.set_xticks(orders, [f"{bay / n * 1e3:.0f}" for n in orders])
    axes.tick_params(axis="x", length=0)
    axes.grid(False, axis="x")
    axes.set_xlim(0.4, ORDERS + 0.6)
    axes.set_xlabel("Wavelength (mm): support spacing and its fractions")
    axes.set_ylabel("Force amplitude (% of static)")
    figure_legend(figure, axes)
    return figure


def _bars_caption(results: StudyResults, found: dict[str, Passing]) -> str:
    low, high = next(iter(found.values())).window
    text = (
        "Amplitudes of the contact force on the smooth rail at the support spacing and its "
        f"fractions, in per cent of the static load, fitted from X = {exact(low)} to "
        f"{exact(high)} m."
    )
    parts = [f"{label(name)} {number(p.percent(1), 3)} %" for name, p in found.items()]
    text += f" Sleeper-passing: {', '.join(parts)}."
    worst: dict[str, tuple[float, str]] = {}
    for name, p in found.items():
        for order, kind in named_orders(results, name).items():
            if kind != "sleeper" and order <= ORDERS:
                worst[kind] = max(worst.get(kind, (0.0, name)), (p.percent(order), name))
    for kind, (percent, name) in worst.items():
        text += f" The largest {kind}-passing component is {number(percent, 2)} % ({label(name)})."
    return text
