"""The contact patch along a run as a GIF: pressure on the tread nodes, and the force."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare.signals import position, values
from contactstudy.files import writing
from contactstudy.plot.gif import write_gif
from contactstudy.plot.style import BLACK, VERMILION, figure_style, map_axes, new_figure
from contactstudy.plot.text import exact, label
from contactstudy.solvers.whole_patch import whole_grid
from contactstudy.study.results import FIGURES, StudyResults

_WIDTH, _HEIGHT = 6.0, 4.2  # inch


@dataclass(frozen=True)
class PatchFrames:
    """Pressure on the whole patch at many instants.

    Attributes
    ----------
    x, y : (n,), (m,) array
        Grid lines relative to the wheel, mm.
    pressure : (frames, n, m) array
        MPa; 0 where nothing touches.
    position : (frames,) array
        Of the wheel, m.
    """

    x: Array
    y: Array
    pressure: Array
    position: Array


def write_animations(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write out_dir/figures/patch.gif for the runs that kept frames.

    With several such runs the files are patch_<run>.gif. Equal results give equal bytes.
    """
    found = {name: run for name, run in results.runs.items() if "frame_pressure" in run.variables}
    written = []
    for name, run in found.items():
        suffix = f"_{name}" if len(found) > 1 else ""
        target = Path(out_dir) / FIGURES / f"patch{suffix}.gif"
        with writing(target) as stream, figure_style():
            _animate(name, run, stream)
        written.append(target)
    return written


def frames_of(run: xr.Dataset) -> PatchFrames:
    """PatchFrames of a run, both halves of a symmetric model."""
    pressure = np.asarray(run["frame_pressure"].transpose("frame", "point").values)
    x, y, grid = whole_grid(run, pressure)
    return PatchFrames(x, y, grid * 1e-6, np.asarray(run["frame_position"].values, dtype=float))


def _animate(name: str, run: xr.Dataset, stream: BinaryIO) -> None:
    frames = frames_of(run)
    figure, parts = _draw(name, run, frames)
    moving = [parts[name] for name in ("image", "line", "title")]
    write_gif(figure, moving, len(frames.position), lambda k: _show(parts, frames, k), stream)


def _draw(name: str, run: xr.Dataset, frames: PatchFrames) -> tuple[Figure, Mapping[str, Any]]:
    """Everything that stays, and the parts that move."""
    figure = new_figure(_HEIGHT, _WIDTH)
    patch, trace = figure.subplots(2, 1, height_ratios=[2.2, 1.0])
    image = patch.pcolormesh(
        frames.x, frames.y, frames.pressure[0].T, cmap="cividis_r", vmin=0.0,
        vmax=max(float(frames.pressure.max()), 1.0), shading="nearest",
    )  # fmt: skip
    figure.colorbar(image, ax=patch, label="Pressure (MPa)")
    map_axes(patch, "Along the rail, from the wheel (mm)", "Across (mm)")
    x, force = position(run), values(run, "contact_force") * 1e-3
    on = (x >= frames.position[0]) & (x <= frames.position[-1])
    trace.plot(x[on], force[on], color=BLACK, lw=0.8)
    line = trace.axvline(frames.position[0], color=VERMILION, lw=1.2)
    trace.margins(x=0)
    trace.set(xlabel="Position X of the wheel (m)", ylabel="Force (kN)")
    title = patch.set_title(f"{label(name)}: X = {exact(frames.position[0], 6)} m")
    parts = {"image": image, "line": line, "title": title, "name": label(name), "x": x}
    return figure, parts | {"force": force}


def _show(parts: Mapping[str, Any], frames: PatchFrames, k: int) -> None:
    pressure = frames.pressure[k].T
    # no colour where nothing touches
    parts["image"].set_array(np.ma.masked_where(pressure <= 0.0, pressure))
    at = float(frames.position[k])
    parts["line"].set_xdata([at, at])
    force = float(np.interp(at, parts["x"], parts["force"]))
    parts["title"].set_text(f"{parts['name']}: X = {at:.3f} m, {force:.1f} kN")
