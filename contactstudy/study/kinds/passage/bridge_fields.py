"""A bridge and the train on it at many instants as VTU files for ParaView.

Of the run that is also drawn (`figures.bridge_picture`) a file an instant k, and their times::

    fields/bridge_<k>.vtu   rails, decks, piers as lines, car bodies as hexahedra, wheels as points
    fields/bridge.pvd       opens all of them

Points lie where the parts are at rest, wheels and cars where they are at that instant: X along the
track, Y to the left, Z up from the decks' axis, in metres. Their data: ``displacement`` [m], to be
enlarged by "Warp By Vector"; ``contact_force`` [N] of wheels; ``part``: rail 0, deck 1, pier 2,
car 3, wheel 4. Width and height of bodies are those of a usual car, whatever the car.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.signals import way
from contactstudy.export.paraview import Piece, collection, vtu
from contactstudy.figures.bridge_picture import shown
from contactstudy.figures.bridge_scene import BODY
from contactstudy.figures.resolved_track import bridge_of
from contactstudy.files import write_file
from contactstudy.solvers.bridge_frames import frame_steps, running_surface
from contactstudy.study.kinds.passage.kind import FIELDS
from contactstudy.study.results import StudyResults
from contactstudy.track.bridge import Bridge

if TYPE_CHECKING:
    import meshio
    import xarray as xr

CAR, WHEEL = 3, 4
"""Beside the parts of `solvers.bridge_frames`."""
_HALF_WIDTH, _CENTRE = 1.45, 1.8  # m; height of a body's centre above the running surface


def write_bridge(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write the fields; nothing where no frames were kept. Equal results give equal bytes."""
    found = shown(results)
    if found is None:
        return []
    run, bridge = found[1], bridge_of(results.config["track"])
    folder, written, pieces = Path(out_dir) / FIELDS, list[Path](), list[Piece]()
    for k, time in enumerate(np.asarray(run["frame_time"].values).tolist()):
        target = folder / f"bridge_{k}.vtu"
        write_file(target, vtu(frame_mesh(run, bridge, k)))
        pieces.append(Piece(time, 0, "bridge", target.name))
        written.append(target)
    write_file(folder / "bridge.pvd", collection(pieces))
    return [*written, folder / "bridge.pvd"]


def frame_mesh(run: xr.Dataset, bridge: Bridge, frame: int) -> meshio.Mesh:
    """Everything at one instant."""
    import meshio

    parts = [_structure(run, frame), _wheels(run, bridge, frame), *_cars(run, bridge, frame)]
    points, cells, first = [], list[tuple[str, Array]](), 0
    for part in parts:
        points.append(part["points"])
        cells.append((part["kind"], part["cells"] + first))
        first += len(part["points"])
    data = {
        name: np.concatenate([part[name] for part in parts]).astype(np.float32)
        for name in ("displacement", "contact_force", "part")
    }
    return meshio.Mesh(np.concatenate(points).astype(np.float32), cells, point_data=data)


def _structure(run: xr.Dataset, frame: int) -> dict[str, Any]:
    """Lines through the nodes of rails, decks and piers."""
    chain = run["node_chain"].values
    joined = np.flatnonzero(chain[1:] == chain[:-1])
    moved = np.zeros((len(chain), 3))
    for axis in run["axis"].values.tolist():
        moved[:, "XYZ".index(axis)] = run["frame_displacement"].sel(axis=axis)[frame]
    return {
        "points": np.stack([run[f"node_{n}"].values for n in "xyz"], axis=1),
        "kind": "line",
        "cells": np.stack([joined, joined + 1], axis=1),
        "displacement": moved,
        "contact_force": np.zeros(len(chain)),
        "part": run["node_part"].values,
    }


def _wheels(run: xr.Dataset, bridge: Bridge, frame: int) -> dict[str, Any]:
    """Points on the running surface, of a planar run in the middle of the track."""
    now = run.isel(time=int(frame_steps(run)[frame]))
    x, up, force = (
        np.atleast_1d(now[name].values)
        for name in ("position", "wheel_displacement", "contact_force")
    )
    n, moved = len(x), np.zeros((len(x), 3))
    moved[:, 2] = up
    y = np.full(n, bridge.track_offset)
    if "wheel_lateral" in now:  # wheelset by wheelset, the vehicle's right wheel first
        moved[:, 1] = now["wheel_lateral"].values
        sides = bridge.lateral_of_rails
        y = np.tile(sides if way(run) > 0.0 else sides[::-1], n // 2)
    return {
        "points": np.stack([x, y, np.full(n, running_surface(bridge.track_height))], axis=1),
        "kind": "vertex",
        "cells": np.arange(n)[:, None],
        "displacement": moved,
        "contact_force": force,
        "part": np.full(n, WHEEL),
    }


def _cars(run: xr.Dataset, bridge: Bridge, frame: int) -> list[dict[str, Any]]:
    """Car bodies as hexahedra that move as rigid bodies."""
    names = list(map(str, run["vehicle_dof"].values))
    if "car_outline" not in run:
        return []
    u = np.asarray(run["frame_vehicle"].values[frame], dtype=float)
    lead, ahead = float(run["frame_position"][frame]), way(run)
    surface, made = running_surface(bridge.track_height), []
    for k, outline in enumerate(run["car_outline"].values, start=1):
        middle = 0.5 * (outline[1] + outline[2])
        # lower face, then upper face; in the car's own axes about its centre, which look forward
        along = np.tile([outline[3], outline[0], outline[0], outline[3]], 2) - middle
        across = np.tile([-_HALF_WIDTH, -_HALF_WIDTH, _HALF_WIDTH, _HALF_WIDTH], 2)
        above = np.repeat(BODY, 4) - _CENTRE
        moved = _rigid(dict(zip(names, u, strict=True)), k, along, across, above)
        place = [
            lead + ahead * (along + middle),
            bridge.track_offset + ahead * across,
            surface + _CENTRE + above,
        ]
        made.append(
            {
                "points": np.stack(place, axis=1),
                "kind": "hexahedron",
                "cells": np.arange(8)[None],
                "displacement": moved * [ahead, ahead, 1.0],
                "contact_force": np.zeros(8),
                "part": np.full(8, CAR),
            }
        )
    return made


def _rigid(u: dict[str, float], car: int, x: Array, y: Array, z: Array) -> Array:
    """Displacement (n, 3) of points of a car's body: translation and turn x arm, see `bodies`."""
    of = {dof: u.get(f"car {dof} {car}", 0.0) for dof in ("y", "z", "roll", "pitch", "yaw")}
    return np.stack(
        [
            -of["yaw"] * y,
            of["y"] + of["yaw"] * x - of["roll"] * z,
            of["z"] + of["roll"] * y - of["pitch"] * x,
        ],
        axis=1,
    )
