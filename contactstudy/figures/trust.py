"""Where a point scheme can be trusted: its error on sinusoids over wavelength, amplitude, speed.

Drawn in are the levels that railways have (ISO 3095's limit, the paper's Table 1, a measured one),
where contact is first lost, where a wheel rests on two crests, the length of the patch, and where
the reference's own error is not small.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullFormatter

from contactstudy.arrays import Array
from contactstudy.figures.axes.maps import edges, hatch
from contactstudy.figures.trust_levels import limit_level, measured_level, paper_level
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, GREEN, GREY, VERMILION, new_figure
from contactstudy.plot.text import exact, label, number
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
_FEW = 2
"""Speeds beside each other at most for which there is room for more ticks and for labels."""
_LEAST = 1e-9
"""Error of the reference that counts as none."""
_SELECT = {"signal": "contact_force", "part": "irregularity"}


@dataclass(frozen=True)
class TrustMap:
    """Errors in per cent (run, speed, amplitude, wavelength), and what stands beside them.

    Attributes
    ----------
    lost : DataArray
        1 where the reference loses contact, nan where there is none (speed, amplitude, wavelength).
    own : DataArray or None
        The reference's own error in per cent (speed, wavelength), where a companion gives it.
    refined : tuple of str
        What the companion refines.
    radius, patch : float
        Of the wheel; length of its patch on a smooth rail, nan if unknown; in m.
    measured : tuple of ndarray, or None
        Wavelengths and amplitudes of a measured roughness in m.
    """

    errors: xr.DataArray
    lost: xr.DataArray
    own: xr.DataArray | None
    refined: tuple[str, ...]
    radius: float
    patch: float
    measured: tuple[Array, Array] | None
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
    own, refined = _own_error(results, data)
    axes = [axis_of(data, key) for key in keys]
    radius = float(results.config["vehicle"]["wheel_radius"])
    return TrustMap(
        errors, lost, own, refined, radius, _patch(results, data), measured_level(results), *axes
    )


def _patch(results: StudyResults, data: xr.Dataset) -> float:
    """Length of the reference's patch at rest [m]."""
    if "semi_axis_along" not in data["static"]["signal"].values:
        return float("nan")
    half = data["static"].sel(run=results.reference, signal="semi_axis_along")
    return 2.0 * float(half.max())


def _own_error(
    results: StudyResults, data: xr.Dataset
) -> tuple[xr.DataArray | None, tuple[str, ...]]:
    """Sum of the differences from the finest, of all that a companion refines, and of what.

    At the values that the map has, over its wavelengths and speeds; between those of the companion
    it is interpolated: its logarithm, over that of the wavelength and over the speed, for it grows
    by decades where a wave comes near a mode that is left out.
    """
    total, refined = None, list[str]()
    for companion in results.companions:
        for design in companion.designs.values():
            key = design.attrs["refined"]
            if not key or not {WAVELENGTH, SPEED} <= set(design.dims):
                continue
            at = design["from_finest"].sel(_SELECT).isel(run=0)
            at = at.sel({key: _given(companion, design, key)}, method="nearest", drop=True)
            at = at.copy(data=np.log(np.maximum(at.values, _LEAST)))
            at = at.assign_coords({WAVELENGTH: np.log(at[WAVELENGTH])})
            points = {WAVELENGTH: np.log(data[WAVELENGTH].values), SPEED: data[SPEED].values}
            found = _interpolated(at, points).transpose(SPEED, WAVELENGTH)
            found = found.copy(data=np.exp(found.values))
            total = found if total is None else total + found
            refined.append(label(key.rpartition(".")[2]))
    return (None if total is None else 100.0 * total), tuple(refined)


def _given(companion: StudyResults, design: xr.Dataset, key: str) -> float:
    """The value of a refined key that the map has, as on the refinement's axis."""
    if design[key].attrs.get("factor_of"):
        return 1.0
    *tables, name = key.split(".")
    of: Any = companion.config
    for table in tables:
        of = of[table]
    return float(of[name])


def _interpolated(values: xr.DataArray, points: dict[str, Array]) -> xr.DataArray:
    for dim, at in points.items():
        values = (
            values.interp({dim: at})
            if values.sizes[dim] > 1
            else values.reindex({dim: at}, method="nearest", tolerance=1e-9)
        )
    return values


def drawings(results: StudyResults) -> list[Drawing]:
    """The map, where the study is one."""
    found = trust_map(results)
    if found is None:
        return []
    return [Drawing("trust_map", _caption(found), lambda: _draw(found), _found(found))]


def _found(found: TrustMap) -> str:
    return f"Share of the map on which the error is below 5 %: {_trusted(found)}."


def _trusted(found: TrustMap) -> str:
    told = []
    for run in found.runs:
        errors = found.errors.sel(run=run)
        share = float((errors < 5.0).sum() / errors.notnull().sum())
        told.append(f"{label(run)} {number(100 * share, 2)} %")
    return ", ".join(told)


def _caption(found: TrustMap) -> str:
    text = (
        "Error of the part of the contact force that the irregularity causes, per cent; rows: "
        "schemes, columns: speeds. Share of the cells below 5 %: "
        f"{_trusted(found)}. Black: contours of 1, 2, 5 and 10 %. Blue: limit of ISO 3095; grey, "
        "dashed: amplitude of a third octave of the paper's Table 1."
    )
    if found.measured is not None:
        text += " Green: the measured roughness."
    lost = found.lost.values
    text += (
        " Red: the reference loses contact above it."
        if np.nansum(lost) > 0.0
        else " The reference never loses contact."
    )
    if np.isnan(found.errors.values).all(axis=0).any():
        text += (
            " Empty, above the dotted line: the troughs are sharper than the wheel, which would "
            "rest on two crests."
        )
    if np.isfinite(found.patch):
        text += (
            f" The patch is {number(1e3 * found.patch)} mm long at rest"
            f"{' (dash-dotted)' if found.patch > _left(found) else ', left of the map'}."
        )
    if found.own is not None:
        text += (
            " Hatched: the reference's own error is more than a third of the difference; it is "
            "the sum of its differences from finer "
            f"{', '.join(found.refined)}, at most {number(float(found.own.max()), 2)} %."
        )
    return text


def _left(found: TrustMap) -> float:
    """Left end of the map [m]."""
    return float(found.edges[0][0] / _units(found)[0])


def _draw(found: TrustMap) -> Figure:
    speeds, runs = len(found.speed.at), found.runs
    figure = new_figure(0.8 + 1.1 * len(runs))
    grid = figure.subplots(len(runs), speeds, sharex=True, sharey=True, squeeze=False)
    norm = BoundaryNorm(_BOUNDS, 256, extend="both")
    mesh: Any = None
    for row, run in zip(grid, runs, strict=True):
        for k, axes in enumerate(row):
            values = found.errors.sel(run=run).values[k]
            mesh = axes.pcolormesh(
                *found.edges, values, norm=norm, cmap="viridis_r", rasterized=True
            )
            axes.set(xscale="log", yscale="log")
            axes.grid(False)
            _overlay(axes, found, values, k)
        row[0].set_ylabel(label(run), fontsize=8)
    unit = _units(found)[0]
    _natural(grid[0, 0].xaxis, found.edges[0] / unit, unit, wide=speeds <= _FEW)
    for axes, name in zip(grid[0], found.speed.names, strict=True):
        axes.set_title(name)
    figure.supxlabel("wavelength", fontsize=9)
    figure.supylabel(found.amplitude.title, fontsize=9)
    bar = figure.colorbar(
        mesh, ax=grid.ravel().tolist(), label="error (%)", shrink=0.6, fraction=0.05, aspect=30
    )
    bar.set_ticks(_BOUNDS, labels=[exact(v) for v in _BOUNDS])
    return figure


def _natural(axis: Any, metres: Array, unit: float, wide: bool) -> None:
    """Ticks at round lengths, below a metre in mm; `unit` is what the axis has for a metre."""
    first, last = np.floor(np.log10(metres[0])), np.ceil(np.log10(metres[-1]))
    decades = 10.0 ** np.arange(first, last + 1)
    close = metres[-1] < 20.0 * metres[0]
    steps = (1.0, 2.0, 5.0) if close else (1.0, 3.0) if wide else (1.0,)
    at = [d * s for d in decades for s in steps if metres[0] <= d * s <= metres[-1]]
    axis.set_major_locator(FixedLocator([unit * v for v in at]))
    axis.set_minor_formatter(NullFormatter())
    names = [f"{exact(1e3 * v, 3)} mm" if v < 0.999 else f"{exact(v, 3)} m" for v in at]
    axis.set_ticklabels(names)


def _overlay(axes: Axes, found: TrustMap, values: Array, speed: int) -> None:
    x, y = found.wavelength.at, found.amplitude.at
    if min(values.shape) >= 2 and np.isfinite(values).any():
        inside = [v for v in LEVELS if np.nanmin(values) < v < np.nanmax(values)]
        there = np.ma.masked_invalid(values)
        if inside:
            lines = axes.contour(x, y, there, levels=inside, colors=BLACK, linewidths=0.7)
            if len(found.speed.at) <= _FEW:
                axes.clabel(lines, fontsize=6, fmt=exact)
        lost = np.ma.masked_invalid(found.lost.values[speed])
        if 0.0 < lost.mean() < 1.0:
            axes.contour(x, y, lost, levels=[0.5], colors=VERMILION, linewidths=1.0)
    if found.own is not None:
        doubtful = found.own.values[speed][None, :] > _SHARE * values
        hatch(axes, *found.edges, doubtful)
    unit, (low, high) = _units(found), found.edges[0][[0, -1]]
    wave = np.geomspace(low, high, 50) / unit[0]
    sharp = wave, wave**2 / (4.0 * np.pi**2 * found.radius)
    levels = [(limit_level(), BLUE, "-"), (paper_level(), GREY, "--"), (sharp, BLACK, ":")]
    if found.measured is not None:
        levels.append((found.measured, GREEN, "-"))
    for (wave, amplitude), color, dashes in levels:
        at = (wave * unit[0] >= low) & (wave * unit[0] <= high)
        axes.plot(wave[at] * unit[0], amplitude[at] * unit[1], color=color, ls=dashes, lw=0.9)
    if found.patch * unit[0] > low:
        axes.axvline(found.patch * unit[0], color=GREY, ls="-.", lw=0.9)
    axes.set_xlim(low, high)
    axes.set_ylim(found.edges[1][0], found.edges[1][-1])


def _units(found: TrustMap) -> tuple[float, float]:
    """Units of the axes per metre."""
    data = found.errors
    return (
        float(found.wavelength.at[0] / data[WAVELENGTH].values[0]),
        float(found.amplitude.at[0] / data[AMPLITUDE].values[0]),
    )
