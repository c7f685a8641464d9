"""Where a point scheme can be trusted: its error on sinusoids over wavelength, amplitude, speed.

Drawn in are the levels that railways have (ISO 3095's limit, the paper's Table 1), where contact
is first lost, and where the reference's own error is not small.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.axes.maps import edges, hatch
from contactstudy.irregularity.chosen import Irregularity
from contactstudy.irregularity.limit import ISO_3095_LIMIT
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, GREY, VERMILION, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.axes.axis import AxisOf, axis_of
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr

WAVELENGTH, AMPLITUDE, SPEED = "irregularity.wavelength", "irregularity.amplitude", "journey.speed"
LEVELS = (1.0, 2.0, 5.0, 10.0)
"""Errors whose contours are drawn, per cent."""
_BOUNDS = (0.5, *LEVELS, 20.0, 50.0, 100.0)
_SHARE = 1.0 / 3.0
"""Share of a difference from which the reference's own error is hatched."""
_SELECT = {"signal": "contact_force", "part": "irregularity"}


@dataclass(frozen=True)
class TrustMap:
    """Errors in per cent (run, speed, amplitude, wavelength), and what stands beside them.

    Attributes
    ----------
    lost : DataArray
        1 where the reference loses contact, nan where it failed (speed, amplitude, wavelength).
    own : DataArray or None
        The reference's own error in per cent (speed, wavelength), where a companion gives it.
    """

    errors: xr.DataArray
    lost: xr.DataArray
    own: xr.DataArray | None
    wavelength: AxisOf
    amplitude: AxisOf
    speed: AxisOf

    @property
    def edges(self) -> tuple[Array, Array]:
        """Edges of the cells along wavelength and amplitude, on logarithmic axes."""
        return edges(self.wavelength, True), edges(self.amplitude, True)

    @property
    def runs(self) -> list[str]:
        """The schemes."""
        return [str(run) for run in self.errors["run"].values]


def trust_map(results: StudyResults) -> TrustMap | None:
    """The map of a study that varies wavelength, amplitude and speed; None for others."""
    data = results.designs.get("sweep")
    keys = [WAVELENGTH, AMPLITUDE, SPEED]
    if data is None or not set(keys) <= set(data.dims) or set(data["variant"].dims) != set(keys):
        return None
    if "relative_l2" not in data or "irregularity" not in data["part"].values:
        return None
    errors = 100.0 * data["relative_l2"].sel(_SELECT).transpose("run", *reversed(keys))
    errors = errors.isel(run=np.flatnonzero(errors.notnull().any(keys).values))
    share = data["contact_lost"].sel(run=results.reference).transpose(*reversed(keys))
    lost = (share > 0.0).where(share.notnull())
    axes = [axis_of(data, key) for key in keys]
    return TrustMap(errors, lost, _own_error(results, data), *axes)


def _own_error(results: StudyResults, data: xr.Dataset) -> xr.DataArray | None:
    """Difference of the coarser mesh that the map has from the finest, at the map's own points."""
    for companion in results.companions:
        refined = companion.designs.get("refine.solid.mesh_size")
        if refined is None or not {WAVELENGTH, SPEED} <= set(refined.dims):
            continue
        size = companion.config["solid"]["mesh_size"]
        at = refined["from_finest"].sel(_SELECT).isel(run=0)
        at = at.sel({"solid.mesh_size": size}, method="nearest")
        points = {WAVELENGTH: data[WAVELENGTH], SPEED: data[SPEED]}
        found = at.reindex(points, method="nearest", tolerance=1e-9)
        return 100.0 * found.transpose(SPEED, WAVELENGTH)
    return None


def drawings(results: StudyResults) -> list[Drawing]:
    """The map, where the study is one."""
    found = trust_map(results)
    if found is None:
        return []
    return [Drawing("trust_map", _caption(found), lambda: _draw(found))]


def _caption(found: TrustMap) -> str:
    told = []
    for run in found.runs:
        errors = found.errors.sel(run=run)
        share = float((errors < 5.0).sum() / errors.notnull().sum())
        told.append(f"{label(run)} {number(100 * share, 2)} %")
    text = (
        "Error of the part of the contact force that the irregularity causes, per cent; rows: "
        "schemes, columns: speeds. Share of the cells below 5 %: "
        f"{', '.join(told)}. Black: contours of 1, 2, 5 and 10 %. Blue: limit of ISO 3095; grey, "
        "dashed: amplitude of a third octave of the paper's Table 1. Red: the reference loses "
        "contact above it."
    )
    if found.own is not None:
        text += (
            " Hatched: the reference's own error, from refining its mesh, is more than a third of "
            "the difference."
        )
    return text


def _draw(found: TrustMap) -> Figure:
    speeds, runs = len(found.speed.at), found.runs
    figure = new_figure(0.9 + 1.45 * len(runs))
    grid = figure.subplots(len(runs), speeds, sharex=True, sharey=True, squeeze=False)
    norm = BoundaryNorm(_BOUNDS, 256, extend="both")
    mesh: Any = None
    for row, run in zip(grid, runs, strict=True):
        for k, axes in enumerate(row):
            values = found.errors.sel(run=run).values[k]
            mesh = axes.pcolormesh(
                *found.edges, values, norm=norm, cmap="viridis_r", rasterized=True
            )
            _overlay(axes, found, values, k)
            axes.set(xscale="log", yscale="log")
            axes.grid(False)
        row[0].set_ylabel(label(run), fontsize=8)
    for axes, name in zip(grid[0], found.speed.names, strict=True):
        axes.set_title(name)
    figure.supxlabel(found.wavelength.title, fontsize=9)
    figure.supylabel(found.amplitude.title, fontsize=9)
    figure.colorbar(mesh, ax=grid.ravel().tolist(), label="error (%)", shrink=0.6)
    return figure


def _overlay(axes: Axes, found: TrustMap, values: Array, speed: int) -> None:
    x, y = found.wavelength.at, found.amplitude.at
    if min(values.shape) >= 2 and np.isfinite(values).any():
        inside = [v for v in LEVELS if np.nanmin(values) < v < np.nanmax(values)]
        there = np.ma.masked_invalid(values)
        if inside:
            lines = axes.contour(x, y, there, levels=inside, colors=BLACK, linewidths=0.7)
            axes.clabel(lines, fontsize=6, fmt=lambda v: number(v, 2))
        lost = np.ma.masked_invalid(found.lost.values[speed])
        if 0.0 < lost.mean() < 1.0:
            axes.contour(x, y, lost, levels=[0.5], colors=VERMILION, linewidths=1.0)
    if found.own is not None:
        doubtful = found.own.values[speed][None, :] > _SHARE * values
        hatch(axes, *found.edges, doubtful)
    unit = _units(found)
    for (wave, amplitude), color, dashes in ((_limit(), BLUE, "-"), (_paper(), GREY, "--")):
        at = (wave * unit[0] >= x.min()) & (wave * unit[0] <= x.max())
        axes.plot(wave[at] * unit[0], amplitude[at] * unit[1], color=color, ls=dashes, lw=0.9)
    axes.set_ylim(found.edges[1][0], found.edges[1][-1])


def _units(found: TrustMap) -> tuple[float, float]:
    """Units of the axes per metre."""
    data = found.errors
    return (
        float(found.wavelength.at[0] / data[WAVELENGTH].values[0]),
        float(found.amplitude.at[0] / data[AMPLITUDE].values[0]),
    )


def _limit() -> tuple[Array, Array]:
    """Wavelengths and amplitudes of waves that alone are at the limit of ISO 3095 [m]."""
    wave, level = np.array(sorted(ISO_3095_LIMIT.items())).T
    return wave, np.sqrt(2.0) * 1e-6 * 10.0 ** (level / 20.0)


def _paper() -> tuple[Array, Array]:
    """Wavelengths of Table 1's band, and amplitudes of waves with a third octave's variance [m]."""
    spectrum, (low, high) = Irregularity().formula(), Irregularity().band
    omega = np.geomspace(low, high, 60)
    # a two-sided density of the standard deviation s in a third octave: s^2 = 2 G(w) dw
    variance = 2.0 * spectrum(omega) * omega * (2 ** (1 / 6) - 2 ** (-1 / 6))
    return 2.0 * np.pi / omega, np.sqrt(2.0 * variance)
