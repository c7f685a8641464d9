"""What touches: contact status of the tread nodes, and the gap around the patch."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch as Swatch

from contactstudy.arrays import Array
from contactstudy.figures.patch import ShownPatch, patches_of, whole_grid
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, SHADE, SKY, map_axes, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.study.results import StudyResults

_GAPS = (5.0, 10.0, 20.0, 50.0)  # µm
_NAMES = ("open", "up to half of its area in contact", "in contact")


@dataclass(frozen=True)
class Status:
    """Nodal fields of one instant on the whole patch.

    Attributes
    ----------
    x, y : (n,), (m,) array
        Grid lines relative to the wheel, mm.
    status : (n, m) array
        Part of the node's area whose points are in contact.
    gap : (n, m) array
        µm; negative: penetration.
    """

    x: Array
    y: Array
    status: Array
    gap: Array


def drawings(results: StudyResults) -> list[Drawing]:
    """Contact status of each run that has stored it."""
    found = patches_of(results, "contact_status")

    def made(name: str, patch: ShownPatch) -> Drawing:
        status = status_of(results.runs[name], patch.instant)
        suffix = f"_{name}" if len(found) > 1 else ""
        caption = _caption(name, results.runs[name], patch, status)
        return Drawing(f"patch_status{suffix}", caption, lambda: _draw(status))

    return [made(name, patch) for name, patch in found.items()]


def status_of(run: xr.Dataset, instant: int) -> Status:
    """Status and gap at one of a run's instants, both halves of a symmetric model."""
    fields = [run[name].isel(instant=instant).values for name in ("contact_status", "gap")]
    x, y, (status, gap) = whole_grid(run, np.array(fields))
    return Status(x, y, status, gap * 1e6)


def _draw(status: Status) -> Figure:
    figure = new_figure(2.9, equal_axes=True)
    left, right = figure.subplots(1, 2, sharey=True)
    # between Gauss points a node well inside the patch may have one that is open
    kind = np.where(status.status > 0.5 + 1e-9, 2, np.where(status.status > 0, 1, 0))
    colours = (SHADE, SKY, BLUE)
    left.pcolormesh(
        status.x, status.y, kind.T, cmap=ListedColormap(colours), vmin=-0.5, vmax=2.5,
        shading="nearest", edgecolors="white", linewidth=0.3,
    )  # fmt: skip
    swatches = [Swatch(color=c, label=n) for c, n in zip(colours, _NAMES, strict=True)]
    figure.legend(handles=swatches, loc="outside upper center", ncols=3)
    lines = right.contour(
        status.x, status.y, status.gap.T, levels=_GAPS, colors=BLACK, linewidths=0.7
    )
    right.clabel(lines, fmt="%g µm", fontsize=7)
    right.contourf(status.x, status.y, status.status.T, levels=[0.5, 2.0], colors=[SKY])
    for ax, text in ((left, "Contact status of the nodes"), (right, "Gap around the patch")):
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
        f"Contact of the run {label(name)} at X = {exact(patch.position)} m: status of the tread "
        "nodes by the part of their area whose points are in contact (left), and the gap around "
        "the patch (right, more than half in contact shaded). The points in contact stand for "
        f"{number(float(area @ nodal) * 1e6)} mm², less than the patch where single points within "
        "it are open; the largest penetration at a node is "
        f"{number(deepest, 2)} µm."
    )
