"""Rail and wheel in section, deformed: drawn where a run carries the meshes of both."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare.signals import position, values
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY, map_axes, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.study.results import StudyResults

# Displacements are drawn so that the largest is this part of the rail's height.
_DRAWN_SHARE = 0.06
_NEAR = 20.0  # mm, half width of the enlarged part


@dataclass(frozen=True)
class ShownSection:
    """Nodes (n, 2), quads (m, 4) and displacements (n, 2) of one body across the rail.

    In m, y lateral and z up.
    """

    nodes: Array
    quads: np.ndarray
    displacement: Array


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for the first run that carries the sections of both bodies, else none."""
    for name, run in results.runs.items():
        rail, wheel = shown_section(run, "rail"), shown_section(run, "wheel")
        if rail is None or wheel is None:
            continue
        # The irregularity lies between the bodies; without it they are drawn in touch.
        level = irregularity_at_instant(run)
        wheel = replace(wheel, displacement=wheel.displacement - np.array([0.0, level]))
        factor = magnification(rail, wheel)
        at = contact_place(run, rail)
        caption = _caption(name, run, rail, wheel, factor, level)
        return [Drawing("deformed_section", caption, partial(_draw, rail, wheel, factor, at))]
    return []


def irregularity_at_instant(run: xr.Dataset) -> float:
    """Irregularity in m under the wheel at the instant whose sections are kept, the first."""
    if "instant_position" not in run or "irregularity" not in run:
        return 0.0
    at = float(np.asarray(run["instant_position"].values).ravel()[0])
    return float(np.interp(at, position(run), values(run, "irregularity")))


def contact_place(run: xr.Dataset, rail: ShownSection) -> Array:
    """Centre of pressure at that instant on the rail's outline, (y, z) in m; the crown if none."""
    if not {"pressure", "point_y"} <= set(run.variables):
        return np.zeros(2)
    first = run.isel(instant=0)
    p, y = (
        np.nan_to_num(np.asarray(first[n].values, dtype=float)) for n in ("pressure", "point_y")
    )
    if not p.max() > 0 or y.min() >= -1e-9:  # nothing touches, or half of a symmetric patch
        return np.zeros(2)
    centre = float(p @ y / p.sum())
    upper = rail.nodes[np.abs(rail.nodes[:, 0] - centre) < 5e-3]
    return np.array([centre, float(upper[:, 1].max())])


def shown_section(run: xr.Dataset, body: str) -> ShownSection | None:
    """Section mesh of `body` ("rail" or "wheel"), mirrored to y < 0 when only half is modelled."""
    names = [f"section_{body}_{part}" for part in ("nodes", "quads", "displacement")]
    if not all(name in run for name in names):
        return None
    nodes, quads, moved = (np.asarray(run[name].values) for name in names)
    quads = quads.astype(int)
    if nodes[:, 0].min() >= -1e-9:
        flip = np.array([-1.0, 1.0])
        quads = np.concatenate([quads, quads[:, ::-1] + len(nodes)])
        nodes, moved = np.concatenate([nodes, nodes * flip]), np.concatenate([moved, moved * flip])
    return ShownSection(nodes, quads, moved)


def magnification(rail: ShownSection, wheel: ShownSection) -> float:
    """Return a round factor (1, 2 or 5 times a power of ten) by which displacements are drawn.

    Both bodies' whole displacements are drawn with it, so that they stay together.
    """
    largest = max(float(np.abs(b.displacement).max()) for b in (rail, wheel))
    if largest == 0.0:
        return 1.0
    height = float(np.ptp(rail.nodes[:, 1]))
    wanted = _DRAWN_SHARE * height / largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(max(s * decade for s in (1.0, 2.0, 5.0) if s * decade <= wanted * (1 + 1e-9)))


def mean_sink(body: ShownSection) -> float:
    """Mean vertical displacement in m over the area of a section."""
    y, z = np.moveaxis(body.nodes[body.quads], 2, 0)
    # shoelace formula, each quad about its own corners
    area = 0.5 * np.abs(np.sum(y * np.roll(z, -1, 1) - np.roll(y, -1, 1) * z, axis=1))
    return float(np.average(body.displacement[:, 1][body.quads].mean(axis=1), weights=area))


def _draw(rail: ShownSection, wheel: ShownSection, factor: float, at: Array) -> Figure:
    figure = new_figure(4.0, equal_axes=True)
    whole, near = figure.subplots(1, 2, width_ratios=[1.0, 2.0])
    sink = mean_sink(rail)
    # What is seen near the contact sets the colours.
    shown = [
        (b.displacement[:, 1] - sink)[np.hypot(*(b.nodes - at).T) < 2e-3 * _NEAR]
        for b in (rail, wheel)
    ]
    seen = 1e6 * np.concatenate([*shown, [0.0]])
    limits = (float(seen.min()), float(seen.max()))
    for body in (rail, wheel):
        _outline(whole, body)
        _body(whole, body, factor, sink, limits)
        image = _body(near, body, 1.0, sink, limits)
    text = "Vertical displacement less the rail's mean (µm)"
    figure.colorbar(image, ax=near, label=text, shrink=0.9)
    whole.autoscale_view()
    y, z = 1e3 * at
    near.set_xlim(y - _NEAR, y + _NEAR)
    near.set_ylim(z - 1.1 * _NEAR, z + 0.9 * _NEAR)
    whole.set_title(f"Displacements × {exact(factor)}")
    near.set_title("Near the contact, true to scale")
    for axes in (whole, near):
        map_axes(axes, "Across the rail y (mm)")
    whole.set_ylabel("Height z above the running surface (mm)")
    return figure


def _body(
    axes: Axes, body: ShownSection, factor: float, sink: float, limits: tuple[float, float]
) -> PolyCollection:
    corners = (body.nodes + factor * body.displacement)[body.quads] * 1e3
    value = (body.displacement[:, 1][body.quads].mean(axis=1) - sink) * 1e6
    faces = PolyCollection(
        list(corners), array=value, cmap="cividis", edgecolors=BLACK, linewidths=0.15
    )
    faces.set_clim(*limits)
    axes.add_collection(faces)
    return faces


def _outline(axes: Axes, body: ShownSection) -> None:
    """Undeformed edge: the element sides that occur once."""
    sides = np.concatenate([body.quads[:, [i, (i + 1) % 4]] for i in range(4)])
    # A half model's plane of symmetry is inside the whole body.
    inner = np.all(np.abs(body.nodes[sides, 0]) < 1e-9, axis=1)
    keys, index, count = np.unique(
        np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True
    )
    edge = sides[index[count == 1]]
    edge = edge[~inner[index[count == 1]]] if keys.size else edge
    lines = body.nodes[edge] * 1e3
    axes.add_collection(
        PolyCollection(
            list(lines), closed=False, facecolors="none", edgecolors=GREY, linewidths=0.7
        )
    )


def _caption(
    name: str, run: xr.Dataset, rail: ShownSection, wheel: ShownSection, factor: float, level: float
) -> str:
    at = run["section_rail_displacement"].attrs.get("section_position")
    where = "" if at is None else f" at X = {exact(float(at))} m"
    sink = mean_sink(rail)
    top = rail.displacement[np.argmin(np.hypot(*rail.nodes.T)), 1] - sink
    hub = wheel.displacement[np.argmax(wheel.nodes[:, 1]), 1] - sink
    text = (
        f"Section through rail and wheel of the run {label(name)}{where}: left with displacements "
        f"drawn {exact(factor)} times, the undeformed outline grey; right near the contact. "
        f"Colours: vertical displacement less the mean of the rail's section, which moves by "
        f"{number(sink * 1e3)} mm. Against that mean the middle of the running surface moves by "
        f"{number(top * 1e6)} µm and the wheel's hub by {number(hub * 1e6)} µm."
    )
    if level:
        text += (
            f" The irregularity there, {number(level * 1e3)} mm, is taken off the wheel's "
            "displacement, so that the bodies are drawn in touch."
        )
    return text
