"""The contact patch: pressure at an instant with Hertz's ellipse over it."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse

from contactstudy.arrays import Array, BoolArray
from contactstudy.compare.signals import position, values
from contactstudy.figures.hertz_ellipse import HertzPatch, hertz_patch
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, VERMILION, map_axes, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.solvers.whole_patch import whole_grid
from contactstudy.study.results import StudyResults


@dataclass(frozen=True)
class Touching:
    """Contact points of one instant on the whole patch.

    Attributes
    ----------
    x, y : (k,), (l,) array
        Grid lines relative to the wheel, mm.
    closed : (k, l) array of bool
        Points that touch.
    """

    x: Array
    y: Array
    closed: BoolArray

    def region(self, x: Array, y: Array) -> BoolArray:
        """Whether places on grid lines (n,), (m,) in mm lie in a patch, (m, n).

        A place is in it where its nearest contact point touches, or is a hole within those that
        do: single points inside a patch are open.
        """
        from scipy.ndimage import binary_fill_holes

        filled = binary_fill_holes(self.closed)
        i, j = (np.abs(u[:, None] - own).argmin(axis=1) for u, own in ((x, self.x), (y, self.y)))
        return np.asarray(filled[np.ix_(i, j)].T, dtype=bool)


def touching_of(run: xr.Dataset, instant: int) -> Touching | None:
    """Contact points at one of a run's instants; None where they are not stored."""
    if "contact_pressure" not in run:
        return None
    own = np.asarray(run["contact_pressure"].isel(instant=instant).values)
    x, y, (pressure,) = whole_grid(run, own, ("contact_x", "contact_y"))
    return Touching(x, y, pressure > 0)


@dataclass(frozen=True)
class ShownPatch:
    """Pressure of one instant on the whole patch (both halves when the model has only one).

    Attributes
    ----------
    x, y : (n,) array
        Points relative to the wheel's contact point, m.
    pressure : (n,) array
        Pa.
    position : float
        Position of the wheel, m.
    force : float
        Contact force at that instant, N.
    instant : int
        Its number among those stored.
    touching : Touching, optional
        The contact points then, where the run has stored them.
    """

    x: Array
    y: Array
    pressure: Array
    position: float
    force: float
    instant: int = 0
    touching: Touching | None = None


def drawings(results: StudyResults) -> list[Drawing]:
    """Pressure map of each run that has stored one."""

    def made(name: str, suffix: str, patch: ShownPatch) -> Drawing:
        hertz = hertz_patch(results, patch.force)
        caption = _map_caption(name, patch, hertz)
        return Drawing(f"patch_pressure{suffix}", caption, lambda: _map(patch, hertz))

    several = sum("pressure" in run for run in results.runs.values()) > 1
    return [
        made(name, f"_{name}" if several else "", patch)
        for name, patch in patches_of(results).items()
    ]


def patches_of(results: StudyResults, *fields: str) -> dict[str, ShownPatch]:
    """Patch of each run that has stored its pressure and the fields named."""
    found = {
        name: patch_of(run)
        for name, run in results.runs.items()
        if {"pressure", *fields} <= set(run.variables)
        and {"instant", "point"} <= set(run["pressure"].dims)
    }
    return {name: patch for name, patch in found.items() if patch is not None}


def patch_of(run: xr.Dataset) -> ShownPatch | None:
    """Pressure at the instant with the largest force among those stored; None if never in touch."""
    at = np.asarray(run["instant_position"].values, dtype=float)
    force = np.interp(at, position(run), values(run, "contact_force"))
    pressure = np.asarray(run["pressure"].transpose("instant", "point").values, dtype=float)
    k = int(np.argmax(np.where(np.nanmax(pressure, axis=1) > 0, force, -np.inf)))
    if not np.nanmax(pressure[k]) > 0:
        return None
    x, y = (_of_instant(run[name], k) for name in ("point_x", "point_y"))
    p = np.nan_to_num(pressure[k])
    known = np.isfinite(x) & np.isfinite(y)
    x, y, p = x[known], y[known], p[known]
    if abs(float(np.mean(x))) > 0.1:  # positions along the track, not relative to the wheel
        x = x - at[k]
    if y.min() >= -1e-9:  # half model: the other half is its mirror image
        inner = y > 1e-9
        x, y, p = np.r_[x, x[inner]], np.r_[y, -y[inner]], np.r_[p, p[inner]]
    return ShownPatch(x, y, p, float(at[k]), float(force[k]), k, touching_of(run, k))


def _of_instant(data: xr.DataArray, k: int) -> Array:
    if "instant" in data.dims:
        data = data.isel(instant=k)
    return np.asarray(data.values, dtype=float)


def _map(patch: ShownPatch, hertz: HertzPatch | None) -> Figure:
    figure = new_figure(3.0)
    left, right = figure.subplots(1, 2, width_ratios=[1.35, 1.0])
    x, y, p = patch.x * 1e3, patch.y * 1e3, patch.pressure * 1e-6
    # a patch off the crown is drawn about its centre, a centred one about the wheel's
    middle = 0.5 * (y[p > 0].min() + y[p > 0].max())
    half = 1.35 * max(np.abs(x[p > 0]).max(), np.abs(y[p > 0] - middle).max())
    if hertz is not None:
        half = max(half, 1.25e3 * max(hertz.along, hertz.across))
    image = _field(left, x, y, p, patch.touching)
    if hertz is not None:
        size = (2e3 * hertz.along, 2e3 * hertz.across)
        left.add_patch(Ellipse((0, 0), *size, fill=False, ec=VERMILION, lw=1.4, ls="--"))
        proxy = Line2D([], [], color=VERMILION, lw=1.4, ls="--", label="Hertz's ellipse")
        left.legend(handles=[proxy], loc="upper right")
    left.set_xlim(-half, half)
    left.set_ylim(middle - half, middle + half)
    map_axes(left, "Along the rail (mm)", "Across the rail (mm)")
    figure.colorbar(image, ax=left, label="Pressure (MPa)", shrink=0.9)
    _cuts(right, x, y - y[np.argmax(p)] if hertz is None else y, p, hertz, half)
    return figure


def _field(axes: Axes, x: Array, y: Array, p: Array, touching: Touching | None) -> ScalarMappable:
    """The bilinear field between nodes that form a grid, as in the elements; else by triangles."""
    gx, ix = np.unique(np.round(x, 6), return_inverse=True)
    gy, iy = np.unique(np.round(y, 6), return_inverse=True)
    if gx.size * gy.size == x.size:
        grid = np.full((gy.size, gx.size), np.nan)
        grid[iy, ix] = p
        fine_x, fine_y, fine = bilinear(gx, gy, grid)
        inside = fine > 0 if touching is None else touching.region(fine_x, fine_y)
        shown = np.where(inside, fine, np.nan)  # no colour where nothing touches
        return axes.pcolormesh(fine_x, fine_y, shown, cmap="cividis_r", vmin=0, shading="nearest")
    levels = np.linspace(0, p.max(), 13)
    return axes.tricontourf(x, y, p, levels=levels, cmap="cividis_r")


def bilinear(x: Array, y: Array, grid: Array, parts: int = 8) -> tuple[Array, Array, Array]:
    """A field (m, n) on grid lines (n,), (m,), with so many parts between two of them."""
    fine = [
        np.interp(np.arange((len(u) - 1) * parts + 1) / parts, np.arange(len(u)), u) for u in (x, y)
    ]
    along = np.array([np.interp(fine[0], x, row) for row in grid])
    return fine[0], fine[1], np.array([np.interp(fine[1], y, column) for column in along.T]).T


def _cuts(axes: Axes, x: Array, y: Array, p: Array, hertz: HertzPatch | None, half: float) -> None:
    for u, v, marker, fill, text in (
        (x, y, "o", BLACK, "along" if hertz is None else "along, y = 0"),
        (y, x, "s", "none", "across"),
    ):
        # The row of nodes nearest to the point of highest pressure.
        on = np.isclose(v, v[np.argmin(np.abs(v))], atol=1e-6)
        order = np.argsort(u[on])
        axes.plot(
            u[on][order], p[on][order], marker=marker, ms=3.5, ls="none", mec=BLACK, mfc=fill,
            mew=0.7, label=text,
        )  # fmt: skip
    if hertz is not None:
        for semi, dashes, text in (
            (hertz.along * 1e3, "-", "Hertz, along"),
            (hertz.across * 1e3, "--", "Hertz, across"),
        ):
            s = np.linspace(-semi, semi, 201)
            curve = hertz.peak_pressure * 1e-6 * np.sqrt(np.maximum(0.0, 1 - (s / semi) ** 2))
            axes.plot(s, curve, color=VERMILION, ls=dashes, lw=1.0, label=text)
    axes.set_xlim(-half, half)
    axes.set_ylim(bottom=0)
    axes.set_ylim(0, 1.45 * axes.get_ylim()[1])
    where = "peak" if hertz is None else "centre"
    axes.set(xlabel=f"Distance from the {where} (mm)", ylabel="Pressure (MPa)")
    axes.legend(loc="upper center", ncols=2, columnspacing=1.0, handlelength=2.0)


def _map_caption(name: str, patch: ShownPatch, hertz: HertzPatch | None) -> str:
    peak = patch.pressure.max()
    # where the cuts cross: a patch without Hertz's ellipse may lie off the crown
    middle = "node of highest pressure" if hertz is None else "centre"
    text = (
        f"Contact pressure of the run {label(name)} at X = {exact(patch.position)} m, where the "
        f"force is {number(patch.force * 1e-3)} kN: map (left) and cuts through the "
        f"{middle} (right). The highest nodal pressure is {number(peak * 1e-6)} MPa"
    )
    if hertz is None:
        return text + "."
    ratio = peak / hertz.peak_pressure - 1
    side = "above" if ratio > 0 else "below"
    return text + (
        f", {number(abs(ratio) * 100, 2)} % {side} Hertz's "
        f"{number(hertz.peak_pressure * 1e-6)} MPa for that force on the same radii "
        f"({hertz.radii}), whose ellipse has semi-axes of "
        f"{number(hertz.along * 1e3)} mm along and {number(hertz.across * 1e3)} mm across the rail."
    )
