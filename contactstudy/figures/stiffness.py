"""The error over the contact stiffness of a linear point contact, with the best constant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY, figure_legend, new_figure, run_styles
from contactstudy.plot.text import between, label, number
from contactstudy.study.axes.axis import axis_of
from contactstudy.study.results import StudyResults

SECANT = 2.0 / 3.0
"""Secant of a contact that grows with the power 3/2 of the approach, in tangents."""


@dataclass(frozen=True)
class Curve:
    """Error [%] of one run at k_r [tangents], in a panel and under a name."""

    panel: str
    name: str
    k_r: Array
    error: Array

    @property
    def best(self) -> tuple[float, float]:
        """k_r of the smallest error, and that error: a parabola of logarithms through three."""
        k = int(np.argmin(self.error))
        if not 0 < k < len(self.k_r) - 1:
            return float(self.k_r[k]), float(self.error[k])
        x, y = np.log(self.k_r[k - 1 : k + 2]), np.log(self.error[k - 1 : k + 2])
        a, b, c = np.polyfit(x, y, 2)
        at = -b / (2.0 * a)
        return float(np.exp(at)), float(np.exp(np.polyval((a, b, c), at)))


def curves(results: StudyResults) -> list[Curve]:
    """A curve a point of the other keys; none where no stiffness in tangents is varied."""
    data = results.designs.get("sweep")
    keys = [str(k) for k in data.dims if str(k).endswith(".k_r")] if data is not None else []
    if data is None or len(keys) != 1 or "relative_l2" not in data:
        return []
    (key,) = keys
    if data[key].attrs.get("factor_of") != "tangent":
        return []
    part = "irregularity" if "irregularity" in data["part"].values else "dynamic"
    errors = data["relative_l2"].sel(signal="contact_force", part=part, run=key.split(".")[1])
    others = [str(d) for d in data["variant"].dims if d != key]
    order = np.argsort(data[key].values)
    found = []
    for index in np.ndindex(*(data.sizes[d] for d in others)):
        at = dict(zip(others, index, strict=True))
        names = [axis_of(data, d).names[k] for d, k in at.items()]
        panel = names[0] if len(names) > 1 else ""
        values = 100.0 * errors.isel(at).values[order]
        if np.isfinite(values).all():
            found.append(
                Curve(panel, ", ".join(names[1:] or names), data[key].values[order], values)
            )
    return found


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure, where a stiffness is varied."""
    found = curves(results)
    if not found:
        return []
    best = "; ".join(
        f"{label(c.panel)} {c.name}: {number(c.best[0])} tangents, {number(c.best[1])} %".strip()
        for c in found
    )
    text = (
        "Error of the contact force over the constant contact stiffness, in tangents of the static "
        f"press. Marked: the best constant of each curve ({best}). Dashed: the tangent; dotted: "
        "the secant of Hertz's law, two thirds of it."
    )
    largest = [float(c.error[-1]) for c in found]
    seen = (
        f"The constant contact stiffness with the least error of the contact force: {best}. With "
        f"the largest, {number(float(found[0].k_r[-1]))} tangents, the error "
        f"{between(min(largest), max(largest))} %."
    )
    return [Drawing("contact_stiffness", text, lambda: _draw(found), seen)]


def _draw(found: list[Curve]) -> Figure:
    panels = list(dict.fromkeys(c.panel for c in found))
    styles = run_styles(list(dict.fromkeys(c.name for c in found)), None)
    logarithmic = parts.wide(np.concatenate([c.error for c in found]))
    figure = new_figure(3.2)
    grid = figure.subplots(1, len(panels), sharex=True, sharey=True, squeeze=False)[0]
    for axes, panel in zip(grid, panels, strict=True):
        for c in (c for c in found if c.panel == panel):
            style = styles[c.name]
            axes.plot(c.k_r, c.error, label=c.name, **style.line)
            axes.plot(*c.best, marker=style.marker, color=style.color, ms=5, ls="none")
        axes.axvline(1.0, color=BLACK, lw=0.7, ls="--")
        axes.axvline(SECANT, color=GREY, lw=0.7, ls=":")
        axes.set(xscale="log", yscale="log" if logarithmic else "linear", title=label(panel))
        axes.set_xlabel("contact stiffness (tangents)")
    grid[0].set_ylabel("Error of the force (%)")
    figure_legend(figure, grid[0])
    return figure
