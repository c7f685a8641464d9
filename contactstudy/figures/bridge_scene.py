"""A bridge and the train on it at one instant, as a picture whose instant can be changed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare.signals import way
from contactstudy.plot.style import BLACK, BLUE, GREY, SHADE, SKY, VERMILION, new_figure
from contactstudy.plot.text import number
from contactstudy.solvers.bridge_frames import DECK, PIER, RAIL, frame_steps, running_surface
from contactstudy.track.bridge import Bridge

_DRAWN, _ABOVE, _AROUND = 5.6, 1.1, 1.15  # inch: width; height of the upper panel and of labels
_TALLEST = 3.4  # inch, of the lower panel
_WIDEST, _PIER_WIDTH = 90.0, 2.0  # m
_LARGEST = 1.2  # m, of the enlarged displacement
BODY = 1.0, 3.7
"""Lower and upper edge of a car body above the running surface [m]."""
_BOGIE = 0.65  # m, the frames of its bogies
_FRAME, _GAP = 1.6, 0.25  # m, half of a bogie's frame; from a coupler to the body
_RADIUS, _ARROW = 0.46, 2.0  # m, of a wheel; an arrow of a load without a car


class Scene:
    """Above the deflection of the whole bridge; below the span that deflects most, enlarged.

    `run` has frames, see `contactstudy.solvers.bridge_frames`.
    """

    def __init__(self, run: xr.Dataset, bridge: Bridge) -> None:
        self.run, self.bridge = run, bridge
        self.up = np.asarray(run["frame_displacement"].sel(axis="Z").values, dtype=float)
        self.x, self.z = (np.asarray(run[f"node_{n}"].values) for n in "xz")
        self.part, chain = run["node_part"].values, run["node_chain"].values
        ends = np.flatnonzero(np.diff(chain)) + 1
        self.chains = np.split(np.arange(len(chain)), ends)
        decks = np.where(self.part == DECK, np.abs(self.up), -1.0)
        self.worst, self.node = np.unravel_index(int(np.argmax(decks)), decks.shape)
        self.way, self.steps = way(run), frame_steps(run)
        self.factor = _rounded(_LARGEST / max(float(np.abs(self.up).max()), 1e-9))
        self.surface = running_surface(bridge.track_height)
        self.window = self._window()

    def draw(self) -> Figure:
        """Everything that stays, and of what moves the instant of the largest displacement."""
        left, right, low, high = self.window
        below = _DRAWN * (high - low) / (right - left)
        figure = new_figure(_ABOVE + below + _AROUND)
        self.whole, self.near = figure.subplots(2, 1, height_ratios=[_ABOVE, below])
        supports = self.bridge.supports
        margin = 0.02 * (supports[-1] - supports[0]) + 5.0
        self.whole.set_xlim(supports[0] - margin, supports[-1] + margin)
        rows = np.where(self.part == PIER, 0.0, 1e3 * self.up)
        low, high = float(rows.min()), float(rows.max())
        room = 0.1 * (high - low) or 1.0
        self.whole.set_ylim(low - room, high + 2.0 * room)
        self.whole.set(xlabel="X (m)", ylabel="Displacement\n(mm)")
        for x in supports:
            self.whole.axvline(x, color=GREY, lw=0.4, ls=":")
        self.lines = LineCollection([], colors=[], lw=1.1)
        self.whole.add_collection(self.lines)
        (self.dots,) = self.whole.plot([], [], ls="none", marker="o", ms=2.2, color=VERMILION)
        self._stays(self.near)
        self.solid = PolyCollection([], facecolors=SHADE, edgecolors=BLACK, lw=0.6)
        self.bodies = PolyCollection([], facecolors=SKY, edgecolors=BLUE, lw=0.8, alpha=0.8)
        self.thin = LineCollection([], colors=BLACK, lw=0.9)
        self.wheels = EllipseCollection(
            2 * _RADIUS, 2 * _RADIUS, 0.0, units="xy", offsets=np.zeros((0, 2)),
            offset_transform=self.near.transData, facecolors="white", edgecolors=BLACK, lw=0.8,
        )  # fmt: skip
        drawn = self.solid, self.bodies, self.thin, self.wheels
        for one in drawn:
            self.near.add_collection(one)
        self.time = self.near.set_title("", loc="left")
        self.moving: tuple[Artist, ...] = (self.lines, self.dots, *drawn, self.time)
        self.show(int(self.worst))
        return figure

    def _window(self) -> tuple[float, float, float, float]:
        """Limits of X and Z about the span that deflects most [m]."""
        bridge, supports = self.bridge, self.bridge.supports
        k = int(np.clip(np.searchsorted(supports, self.x[self.node]) - 1, 0, len(supports) - 2))
        foot = min(float(self.z.min()), -bridge.bearing_depth - 2.0) - 0.5
        top = self.surface + BODY[1] + 1.0
        width = min(2.0 * (supports[k + 1] - supports[k]), _WIDEST)
        width = max(width, (top - foot) * _DRAWN / _TALLEST)
        middle = 0.5 * (supports[k] + supports[k + 1])
        left = float(np.clip(middle - 0.5 * width, 0.0, max(bridge.length - width, 0.0)))
        return left, left + width, foot, top

    def _stays(self, axes: Axes) -> None:
        bridge, supports = self.bridge, self.bridge.supports
        left, right, low, high = self.window
        axes.set(aspect="equal", xlim=(left, right), xlabel="X (m)", ylabel="Z (m)")
        axes.set_ylim(low, high)
        axes.grid(False)
        for start, end in ((0.0, supports[0]), (supports[-1], bridge.length)):
            axes.fill_between([start, end], low, bridge.track_height, color=SHADE, lw=0, zorder=0)
        if not (self.part == PIER).any():
            depth = -bridge.bearing_depth
            triangles = [[(x, depth), (x - 0.8, depth - 1.4), (x + 0.8, depth - 1.4)]
                         for x in supports[1:-1]]  # fmt: skip
            axes.add_collection(PolyCollection(triangles, facecolors=GREY, edgecolors="none"))

    def show(self, frame: int) -> None:
        """Show a frame."""
        up, enlarged = self.up[frame], self.factor * self.up[frame]
        lines, colours, solid, thin = [], [], list[Any](), list[Any]()
        for own in self.chains:
            part, x, z = self.part[own[0]], self.x[own], self.z[own]
            if part == PIER:
                solid.append(_pier(x, z + enlarged[own]))
                continue
            lines.append(np.stack([x, 1e3 * up[own]], axis=1))
            colours.append(BLUE if part == DECK else GREY)
            if part == DECK:
                solid.append(self._deck(x, enlarged[own]))
            if part == RAIL:
                thin.append(np.stack([x, self.surface + enlarged[own]], axis=1))
        self.lines.set(segments=lines, color=colours)
        at, rail = self._wheels(int(self.steps[frame]))
        self.dots.set_data(at, 1e3 * rail)
        self.solid.set_verts(solid)
        centre = self.surface + _RADIUS + self.factor * rail
        self.wheels.set_offsets(np.stack([at, centre], axis=1))
        bodies, bogies = self._cars(frame, at, self.factor * rail)
        self.bodies.set_verts(bodies)
        thin += bogies
        if not bodies:
            thin += [[(x, z + _RADIUS), (x, z + _RADIUS + _ARROW)]
                     for x, z in zip(at, centre, strict=True)]  # fmt: skip
        self.thin.set_segments(thin)
        text = f"t = {float(self.run['frame_time'][frame]):.3f} s, displacements enlarged "
        self.time.set_text(text + f"{number(self.factor, 1)} times")

    def _deck(self, x: Array, up: Array) -> Array:
        top, low = self.bridge.track_height + up, -self.bridge.bearing_depth + up
        return np.stack([np.r_[x, x[::-1]], np.r_[top, low[::-1]]], axis=1)

    def _wheels(self, step: int) -> tuple[Array, Array]:
        """X of the wheels, and displacement of the rail under them (n,) [m]."""
        now = self.run.isel(time=step)
        x, rail = (np.atleast_1d(now[name].values) for name in ("position", "rail_displacement"))
        order = np.argsort(x)
        return x[order], rail[order]

    def _cars(self, frame: int, wheels: Array, up: Array) -> tuple[list[Array], list[Any]]:
        """Corners of the car bodies and lines of the bogies, which stand on the wheels."""
        if "car_outline" not in self.run:
            return [], []
        lead = float(self.run["frame_position"][frame])
        bodies, bogies = [], []
        for outline in lead + self.way * self.run["car_outline"].values:
            front, rear, pivots = outline[0], outline[3], outline[1:3]
            rise = np.array([up[np.argsort(np.abs(wheels - x))[:2]].mean() for x in pivots])
            bogies += [
                [(x - _FRAME, self.surface + _BOGIE + z), (x + _FRAME, self.surface + _BOGIE + z)]
                for x, z in zip(pivots, rise, strict=True)
            ]
            slope = (rise[0] - rise[1]) / (pivots[0] - pivots[1])
            x = np.array([front - self.way * _GAP, rear + self.way * _GAP])
            lower, upper = (
                self.surface + edge + rise[0] + slope * (x - pivots[0]) for edge in BODY
            )
            bodies.append(np.stack([np.r_[x, x[::-1]], np.r_[lower, upper[::-1]]], axis=1))
        return bodies, bogies


def _pier(x: Array, z: Array) -> Array:
    half = 0.5 * _PIER_WIDTH
    return np.stack([[x[0] - half, x[0] + half, x[-1] + half, x[-1] - half],
                     [z[0], z[0], z[-1], z[-1]]], axis=1)  # fmt: skip


def _rounded(factor: float) -> float:
    """The next lower of 1, 2, 5 times a power of ten, at least 1."""
    if factor <= 1.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(factor))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= factor) * power)
