"""What is modelled: track, wheel, supports and coordinates, drawn from the study's own choices."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle

from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, GREY, SHADE, VERMILION, new_figure
from contactstudy.plot.text import exact
from contactstudy.study.results import StudyResults

_BAYS = 4
_WHEEL = 0.55  # radius of the wheel as drawn, in bays
_THIN: Any = {"color": BLACK, "lw": 0.8, "solid_capstyle": "butt"}


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for a study with runs of its own."""
    if not results.runs or "track" not in results.config:
        return []
    return [Drawing("model", _caption(results), lambda: _draw(results))]


def _draw(results: StudyResults) -> Figure:
    config = results.config
    solvers = [run.get("solver") for run in config.get("runs", {}).values()]
    shown = [s for s in (_point, _surface) if s.__name__.removeprefix("_") in solvers]
    low, top = -1.28, 2.25 if _on_column(config) or len(shown) > 1 else 1.55
    figure = new_figure(0.765 * (top - low), equal_axes=True)
    axes = figure.add_subplot()
    axes.set(aspect="equal", xlim=(-2.75, 5.6), ylim=(low, top))
    axes.axis("off")
    _track(axes, config["track"], _rough(config))
    _vehicle(axes, config)
    _coordinates(axes)
    for k, contact in enumerate(shown):
        contact(axes, 4.45, 0.95 - 1.75 * k if len(shown) > 1 else 0.2)
    return figure


def _rough(config: Mapping[str, Any]) -> bool:
    """Whether the rail is anything but smooth."""
    irregularity = config.get("irregularity", {})
    defect = irregularity.get("rail_defect", "none")
    return irregularity.get("spectrum") != "smooth" or defect != "none"


def _track(axes: Axes, track: Mapping[str, Any], rough: bool) -> None:
    """Rail on its supports: pad, sleeper and what lies below it, or a bedding all along."""
    ends = (-_BAYS / 2 - 0.45, _BAYS / 2 + 0.45)
    axes.add_patch(Rectangle((ends[0], -0.12), ends[1] - ends[0], 0.12, fc=SHADE, ec=BLACK, lw=0.8))
    if rough:
        x = np.linspace(*ends, 400)
        axes.plot(x, 0.035 + 0.03 * np.sin(4.1 * x) * np.sin(1.3 * x + 0.4), color=BLUE, lw=0.9)
        axes.text(ends[0] + 0.02, 0.13, "$r_v(X)$", color=BLUE, fontsize=8, parse_math=True)
    discrete = track.get("support") == "discrete"
    if track.get("support") == "none":
        return
    at = np.arange(-_BAYS / 2, _BAYS / 2 + 0.1) if discrete else np.linspace(*ends, 16)[1:-1]
    layered = discrete and track.get("layer", "none") != "none"
    bottom = -0.92 if layered else -0.55
    for u in at:
        low = -0.42 if layered else bottom
        _spring(axes, u - 0.09, low, -0.12)
        if discrete:
            _damper(axes, u + 0.09, low, -0.12)
        if layered:
            axes.add_patch(Rectangle((u - 0.2, -0.55), 0.4, 0.13, fc="white", ec=BLACK, lw=0.8))
            _spring(axes, u - 0.09, bottom, -0.55)
            _damper(axes, u + 0.09, bottom, -0.55)
    axes.plot(ends, (bottom, bottom), **_THIN)
    for u in np.arange(ends[0], ends[1], 0.12):
        axes.plot((u, u - 0.06), (bottom, bottom - 0.07), color=BLACK, lw=0.4)
    words = [(-0.27, "pad"), (-0.48, "sleeper"), (-0.75, str(track.get("layer", "")))]
    for z, word in words if layered else [(-0.33, "bedding" if not discrete else "pad")]:
        axes.text(ends[1] + 0.06, z, word, fontsize=8, va="center")
    axes.text(ends[1] + 0.06, -0.06, "rail", fontsize=8, va="center")
    if discrete and (spacing := track.get("spacing")):
        z = bottom - 0.2
        axes.annotate("", (-2, z), (-1, z), arrowprops={"arrowstyle": "<->", "lw": 0.6})
        axes.text(-1.5, z - 0.04, f"{exact(float(spacing))} m", fontsize=8, ha="center", va="top")


def _vehicle(axes: Axes, config: Mapping[str, Any]) -> None:
    """The wheel, and the bodies on it where the vehicle has them."""
    z = _WHEEL + 0.06
    axes.add_patch(Circle((0, z), _WHEEL, fc="white", ec=BLACK, lw=0.9))
    axes.add_patch(Circle((0, z), 0.05, fc=BLACK, ec=BLACK))
    if _on_column(config):
        for low, high, half, word in ((1.42, 1.6, 0.34, "bogie"), (1.9, 2.14, 0.6, "car body")):
            axes.add_patch(
                Rectangle((-half, low), 2 * half, high - low, fc="white", ec=BLACK, lw=0.8)
            )
            axes.text(half + 0.07, (low + high) / 2, word, fontsize=8, va="center")
        for low, high in ((z, 1.42), (1.6, 1.9)):
            _spring(axes, -0.12, low, high)
            _damper(axes, 0.12, low, high)
        axes.plot((-0.12, 0.12), (z, z), **_THIN)
    speed = config.get("journey", {}).get("speed")
    if speed is not None:
        axes.annotate(
            "", (1.35, z), (0.72, z), arrowprops={"arrowstyle": "-|>", "lw": 0.9, "color": BLACK}
        )
        axes.text(0.74, z + 0.07, f"{exact(round(3.6 * float(speed), 3))} km/h", fontsize=8)
    axes.text(-_WHEEL - 0.06, z + 0.35, "wheel", fontsize=8, ha="right")


def _on_column(config: Mapping[str, Any]) -> bool:
    """Whether bodies stand on the wheel."""
    return bool(config.get("vehicle", {}).get("type") == "wheel_column")


def _coordinates(axes: Axes) -> None:
    at = (-2.3, 0.75)
    for dx, dz, word in ((0.5, 0.0, "X"), (0.0, 0.5, "Z")):
        tip = (at[0] + dx, at[1] + dz)
        axes.annotate("", tip, at, arrowprops={"arrowstyle": "-|>", "lw": 0.9})
        where = (at[0] + 1.22 * dx, at[1] + 1.22 * dz)
        axes.text(*where, word, fontsize=9, ha="center", va="center")
    axes.add_patch(Circle(at, 0.06, fc="white", ec=BLACK, lw=0.8, zorder=3))
    axes.plot([at[0] - 0.042, at[0] + 0.042], [at[1] - 0.042, at[1] + 0.042], color=BLACK, lw=0.8,
              zorder=4)  # fmt: skip
    axes.plot([at[0] - 0.042, at[0] + 0.042], [at[1] + 0.042, at[1] - 0.042], color=BLACK, lw=0.8,
              zorder=4)  # fmt: skip
    axes.text(at[0] - 0.15, at[1] - 0.16, "Y", fontsize=9, ha="center", va="center")


def _point(axes: Axes, x: float, z: float) -> None:
    """A wheel node over a beam, with a spring between."""
    axes.text(x, z + 1.05, "point contact", fontsize=8, ha="center")
    axes.add_patch(Circle((x, z + 0.75), 0.16, fc="white", ec=BLACK, lw=0.9))
    _spring(axes, x, z + 0.13, z + 0.59, VERMILION)
    axes.text(
        x + 0.14, z + 0.36, "law, $k_r$", fontsize=8, va="center", color=VERMILION, parse_math=True
    )
    axes.plot((x - 0.85, x + 0.85), (z + 0.13, z + 0.13), color=BLACK, lw=2.0)
    axes.plot(
        x + np.array([-0.75, -0.25, 0.25, 0.75]), np.full(4, z + 0.13), "o", color=BLACK, ms=3
    )
    axes.text(x, z - 0.05, "beam", fontsize=8, ha="center", va="top")


def _surface(axes: Axes, x: float, z: float) -> None:
    """A meshed wheel on a meshed rail, with pressure between."""
    axes.text(x, z + 1.0, "surface contact", fontsize=8, ha="center")
    top = z + 0.2
    for k, radius in enumerate((1.4, 1.28, 1.12, 0.9)):
        line = BLACK if k == 0 else GREY
        axes.add_patch(
            Arc((x, top + 1.42), 2 * radius, 2 * radius, theta1=247, theta2=293, ec=line, lw=0.8)
        )
    for angle in np.radians(np.linspace(247, 293, 13)):
        inner, outer = 0.9, 1.4
        axes.plot(
            x + np.array([inner, outer]) * np.cos(angle),
            top + 1.42 + np.array([inner, outer]) * np.sin(angle),
            color=GREY, lw=0.5,
        )  # fmt: skip
    grid = np.linspace(x - 0.8, x + 0.8, 14)
    for depth in (0.0, 0.08, 0.18, 0.32):
        line = BLACK if depth == 0 else GREY
        axes.plot(grid[[0, -1]], (top - depth, top - depth), color=line, lw=0.8)
    for u in grid:
        axes.plot((u, u), (top - 0.32, top), color=GREY, lw=0.5)
    s = np.linspace(-0.2, 0.2, 7)
    for u, p in zip(s, np.sqrt(1 - (s / 0.21) ** 2), strict=True):
        axes.annotate(
            "", (x + u, top), (x + u, top + 0.05 + 0.2 * p),
            arrowprops={"arrowstyle": "-|>", "lw": 0.6, "color": VERMILION, "mutation_scale": 5},
        )  # fmt: skip
    axes.text(x + 0.3, top + 0.18, "$p$", fontsize=8, color=VERMILION, parse_math=True)
    axes.text(x, top - 0.38, "meshed wheel and rail", fontsize=8, ha="center", va="top")


def _spring(axes: Axes, x: float, low: float, high: float, color: str = BLACK) -> None:
    turns = 4
    s = np.r_[0, 0.2 + 0.6 * (np.arange(2 * turns + 1) / (2 * turns)), 1]
    side = np.r_[0, 0, np.where(np.arange(2 * turns - 1) % 2, -1.0, 1.0), 0, 0] * 0.05
    axes.plot(x + side, low + s * (high - low), color=color, lw=0.8)


def _damper(axes: Axes, x: float, low: float, high: float) -> None:
    middle, half = (low + high) / 2, 0.045
    axes.plot((x, x), (low, middle), **_THIN)
    axes.plot((x - half, x + half), (middle, middle), **_THIN)
    axes.plot((x - 1.4 * half, x - 1.4 * half, x + 1.4 * half, x + 1.4 * half),
              (middle - 0.04, middle + 0.06, middle + 0.06, middle - 0.04), **_THIN)  # fmt: skip
    axes.plot((x, x), (middle + 0.06, high), **_THIN)


def _caption(results: StudyResults) -> str:
    config = results.config
    solvers = {run.get("solver") for run in config.get("runs", {}).values()}
    support = {"discrete": "on discrete supports", "none": "without supports"}.get(
        str(config["track"].get("support")), "on a bedding"
    )
    contacts = {"point": "a law at a point of a beam", "surface": "pressure between meshed bodies"}
    several = config.get("vehicle", {}).get("type") not in ("wheel_column", "bare_wheel", None)
    wheel = "one of the wheels" if several else "a wheel"
    rail = "an irregular rail" if _rough(config) else "a smooth rail"
    told = [
        f"The model, not to scale: {wheel} rolls along X over {rail} {support}.",
        "Z points upwards, Y across the track away from the viewer.",
    ]
    if config["track"].get("structure") == "bridge":
        told.append("The decks that carry the supports are not drawn.")
    shown = [text for solver, text in contacts.items() if solver in solvers]
    if shown:
        told.append(f"Contact is {' or '.join(shown)} (right).")
    return " ".join(told)
