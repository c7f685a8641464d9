"""What touches: which contact points do, and the gap around the patch."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch as Swatch

from contactstudy.arrays import Array
from contactstudy.figures.patch import ShownPatch, Touching, bilinear, patches_of, touching_of
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, SHADE, SKY, map_axes, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.solvers.whole_patch import whole_grid
from contactstudy.study.results import StudyResults

_GAPS = (5.0, 10.0, 20.0, 50.0)  # µm


@dataclass(frozen=True)
class Status:
    """Fields of one instant on the whole patch.

    Attributes
    ----------
    x, y : (n,), (m,) array
        Grid lines of the tread nodes relative to the wheel, mm.
    gap : (n, m) array
        At the nodes, µm; negative: penetration.
    points : Touching
        The contact points.
    """

    x: Array
    y: Array
    gap: Array
    points: Touching


def drawings(results: StudyResults) -> list[Drawing]:
    """Contact status of each run that has stored it."""
    found = patches_of(results, "contact_status", "contact_pressure")

    def made(name: str, patch: ShownPatch) -> Drawing:
        status = status_of(results.runs[name], patch.instant)
        suffix = f"_{name}" if len(found) > 1 else ""
        caption = _caption(name, results.runs[name], patch, status)
        return Drawing(f"patch_status{suffix}", caption, lambda: _draw(status))

    return [made(name, patch) for name, patch in found.items()]


def status_of(run: xr.Dataset, instant: int) -> Status:
    """Status and gap at one of a run's instants, both halves of a symmetric model."""
    x, y, (gap,) = whole_grid(run, np.asarray(run["gap"].isel(instant=instant).values))
    points = touching_of(run, instant)
    assert points is not None
    return Status(x, y, gap * 1e6, points)


def _draw(status: Status) -> Figure:
    figure = new_figure(2.9, equal_axes=True)
    left, right = figure.subplots(1, 2, sharey=True)
    left.pcolormesh(
        status.points.x, status.points.y, status.points.closed.T.astype(float),
        cmap=ListedColormap([SHADE, BLUE]), vmin=-0.5, vmax=1.5,
        shading="nearest", edgecolors="white", linewidth=0.3,
    )  # fmt: skip
    swatches = [
        Swatch(color=SHADE, label="open"),
        Swatch(color=BLUE, label="touching"),
        Swatch(color=SKY, label="in the patch"),
    ]
    figure.legend(handles=swatches, loc="outside upper center", ncols=3)
    x, y, gap = bilinear(status.x, status.y, status.gap.T)
    inside = np.where(status.points.region(x, y), 1.0, np.nan)
    right.pcolormesh(x, y, inside, cmap=ListedColormap([SKY]), shading="nearest")
    lines = right.contour(x, y, gap, levels=_GAPS, colors=BLACK, linewidths=0.7)
    right.clabel(lines, fmt="%g µm", fontsize=7)
    for ax, text in ((left, "Contact points"), (right, "Gap around the patch")):
        ax.set_xlim(status.x[0], status.x[-1])
        ax.set_ylim(status.y[0], status.y[-1])
        map_axes(ax, "Along the rail (mm)")
        ax.set_title(text)
    left.set_ylabel("Across the rail (mm)")
    return figure


def _caption(name: str, run: xr.Dataset, patch: ShownPatch, status: Status) -> str:
    area = np.asarray(run["point_area"].values)
    nodal = np.asarray(run["contact_status"].values)[patch.instant]
    deepest = max(-float(status.gap.min()), 0.0)
    return (
        f"Contact of the run {label(name)} at X = {exact(patch.position)} m: the contact points, "
        "four to a facet (left), and the gap around the patch (right). As in the map of pressure, "
        "the patch holds the points that touch and the open ones among them. The points that "
        f"touch stand for {number(float(area @ nodal) * 1e6)} mm². That is less than the patch, "
        "and it jumps as points come and go, so the contact area of a run is taken from the gap "
        f"around the patch. The largest penetration at a node is {number(deepest, 2)} µm."
    )
