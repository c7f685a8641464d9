"""The deformed bridge with the train on it: a picture, and an animation of the passage."""

from pathlib import Path

import numpy as np
import xarray as xr

from contactstudy.figures.bridge_scene import Scene
from contactstudy.figures.resolved_track import bridge_of
from contactstudy.files import writing
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.gif import write_gif
from contactstudy.plot.style import figure_style
from contactstudy.plot.text import label, number
from contactstudy.study.results import FIGURES, StudyResults

PICTURE, ANIMATION = "bridge_passage", "bridge_passage.gif"


def drawings(results: StudyResults) -> list[Drawing]:
    """The picture of one run, where any kept frames."""
    found = shown(results)
    if found is None:
        return []
    scene = Scene(found[1], bridge_of(results.config["track"]))
    return [Drawing(PICTURE, _caption(found[0], scene), scene.draw)]


def shown(results: StudyResults) -> tuple[str, xr.Dataset] | None:
    """Name and data of the run that is shown: the reference, else the first one with frames."""
    names = sorted(results.runs, key=lambda name: name != results.reference)
    for name in names:
        if "frame_displacement" in results.runs[name]:
            return name, results.runs[name]
    return None


def write_animation(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write out_dir/figures/bridge_passage.gif of that run. Equal results give equal bytes."""
    found = shown(results)
    if found is None:
        return []
    scene, target = Scene(found[1], bridge_of(results.config["track"])), Path(out_dir) / FIGURES
    with writing(target / ANIMATION) as stream, figure_style():
        write_gif(scene.draw(), scene.moving, len(scene.up), scene.show, stream)
    return [target / ANIMATION]


def _caption(name: str, scene: Scene) -> str:
    run, k, node = scene.run, int(scene.worst), int(scene.node)
    down = 1e3 * float(scene.up[k, node])
    wheels = np.atleast_1d(run["position"].isel(time=int(scene.steps[k])).values)
    on = np.unique(np.round(wheels, 6))
    on = on[(on >= scene.bridge.supports[0]) & (on <= scene.bridge.supports[-1])]
    at, factor = float(scene.x[node]), number(scene.factor, 1)
    cars = " and cars on their wheels" if "car_outline" in run else ""
    return (
        f"The bridge under the train, {label(name)}, at the instant of the {len(scene.up)} kept at "
        f"which a deck moves most: {number(down, 3)} mm at X = {number(at, 4)} m, {len(on)} "
        "wheelsets on the bridge. Above: displacement of all decks (blue) and of the rail (grey), "
        f"wheels as dots. Below: the span that moves most, its displacements enlarged {factor} "
        f"times; wheels stand on the rail{cars}, without the irregularity and their own motion. "
        f"{FIGURES}/{ANIMATION} shows the whole passage, fields/bridge.pvd opens it in ParaView."
    )
