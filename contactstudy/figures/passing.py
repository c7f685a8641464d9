"""Smooth rail: contact force over a few bays, and its components at the passing wavelengths."""

import numpy as np
from matplotlib.figure import Figure

from contactstudy.compare.signals import position, values
from contactstudy.figures.passing_components import (
    ORDERS,
    Passing,
    all_passing,
    component,
    spacing,
)
from contactstudy.figures.signals import styles, wheel_note
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY, figure_legend, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.study.results import StudyResults

BAYS_SHOWN = 3


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
        order = 3.0 if name == results.reference else 2.0
        line = styles(results)[name].line | {"zorder": order}
        axes.plot(x[keep], force[keep], label=label(name), **line)
    for support in np.arange(low, high + bay / 2, bay):
        axes.axvline(support, color=GREY, lw=0.6, ls=":")
    axes.set(xlabel="Position X of the wheel (m), supports dotted", ylabel="Contact force (kN)")
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
    for kind in ("element", "cell"):
        found_here = {n: component(results, n, p, kind) for n, p in found.items()}
        known = {n: a / found[n].static for n, a in found_here.items() if a is not None}
        if known:
            name = max(known, key=lambda n: known[n])
            text += (
                f" The largest {kind}-passing component is {number(100 * known[name], 2)} % "
                f"({label(name)})."
            )
    return text
