"""Fields of the patch and of the stress below it as VTU files for ParaView.

For every instant k of a run two files, and one collection with their times::

    fields/<run>_patch_<k>.vtu   pressure, gap, penetration and contact status on the tread nodes
    fields/<run>_below_<k>.vtu   stress, von Mises and maximum shear in the body below
    fields/<run>.pvd             opens both, with the time of every instant

Positions are relative to the wheel, in metres: x along the rail, y across it, z up from the
running surface, which is laid out flat. The stresses are those of an elastic half-space under
the pressure, see `contactstudy.halfspace.subsurface`.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.export.paraview import Piece, collection, vtu
from contactstudy.files import write_file
from contactstudy.halfspace.pressure_field import SurfacePressure
from contactstudy.halfspace.subsurface import SHALLOWEST, half_space_stress
from contactstudy.solids.stress import maximum_shear, von_mises
from contactstudy.solvers.patch_fields import instant_pressure
from contactstudy.study.kinds.passage.bridge_fields import write_bridge
from contactstudy.study.kinds.passage.kind import FIELDS
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import meshio
    import xarray as xr

_PARTS = ("patch", "below")
# lines of the body below in patch radii: how far beside the patch, how deep, how far apart
_BESIDE, _DEEP, _STEP = 0.75, 3.0, 0.125


def write_files(results: StudyResults, out_dir: Path) -> list[Path]:
    """Fields for ParaView and animations of patch and bridge, of the runs that kept some."""
    from contactstudy.figures.bridge_picture import write_animation

    written = write_fields(results, out_dir) + write_bridge(results, out_dir)
    written += write_animation(results, out_dir)
    if any("frame_pressure" in run.variables for run in results.runs.values()):
        from contactstudy.figures.animation import write_animations

        written += write_animations(results, out_dir)
    return written


def write_fields(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write the fields of all runs that kept some into `out_dir`/fields.

    None where no instants were chosen. Equal results give equal bytes.
    """
    folder, written = Path(out_dir) / FIELDS, list[Path]()
    for name, run in results.runs.items():
        if "pressure" not in run or "instant" not in run["pressure"].dims:
            continue
        entries = []
        for k, time in enumerate(np.asarray(run["instant_time"].values).tolist()):
            for part, mesh in zip(_PARTS, (patch_mesh(run, k), body_mesh(run, k)), strict=True):
                if mesh is None:
                    continue
                target = folder / f"{name}_{part}_{k}.vtu"
                write_file(target, vtu(mesh))
                entries.append(Piece(time, _PARTS.index(part), part, target.name))
                written.append(target)
        target = folder / f"{name}.pvd"
        write_file(target, collection(entries))
        written.append(target)
    return written


def patch_mesh(run: xr.Dataset, instant: int) -> meshio.Mesh:
    """Tread nodes as quadrilaterals; both halves of a symmetric model.

    The run has fields at instants, see `contactstudy.solvers.patch_fields`.
    """
    import meshio

    x, y = (np.unique(np.asarray(run[name].values)) for name in ("point_x", "point_y"))
    mirrored = bool(run["point_y"].attrs.get("symmetric", y[0] >= -1e-9))
    across = np.r_[-y[:0:-1], y] if mirrored else y
    X, Y = np.meshgrid(x, across, indexing="ij")
    points = np.stack([X.ravel(), Y.ravel(), np.zeros(X.size)], axis=1)
    node = np.arange(X.size).reshape(X.shape)
    quads = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1)
    data = {}
    for name in ("pressure", "gap", "contact_status"):
        if name in run:
            values = np.asarray(run[name].isel(instant=instant).values).reshape(len(x), len(y))
            whole = np.hstack([values[:, :0:-1], values]) if mirrored else values
            data[name] = whole.ravel()
    if "gap" in data:
        data["penetration"] = np.maximum(-data["gap"], 0.0)
    return meshio.Mesh(points, [("quad", quads.reshape(-1, 4))], point_data=data)


def body_mesh(run: xr.Dataset, instant: int) -> meshio.Mesh | None:
    """Block below the patch with its stresses; None where there is no contact."""
    import meshio

    load = instant_pressure(run, instant)
    if not load.area > 0:
        return None
    x, y, depth = _body_lines(load)
    grid = np.stack(np.meshgrid(x, y, depth, indexing="ij"), axis=-1)
    nu = float(run["maximum_shear"].attrs["poisson_ratio"])
    stress = half_space_stress(load, grid.reshape(-1, 3), nu)
    node = np.arange(stress.shape[0]).reshape(grid.shape[:3])
    # a hexahedron's lower face first, then the upper one: depth runs down
    a, b = node[:, :, 1:], node[:, :, :-1]
    corners = [
        face[i : i + len(x) - 1, j : j + len(y) - 1]
        for face in (a, b)
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    # ParaView's order of a symmetric tensor, z up: xx, yy, zz, xy, yz, xz
    tensor = stress[:, [0, 1, 2, 5, 3, 4]] * [1, 1, 1, 1, -1, -1]
    data: dict[str, Any] = {
        "stress": tensor,
        "von_mises": von_mises(stress),
        "maximum_shear": maximum_shear(stress),
    }
    return meshio.Mesh(
        grid.reshape(-1, 3) * [1, 1, -1],
        [("hexahedron", np.stack(corners, axis=-1).reshape(-1, 8))],
        # single precision holds more digits than the mesh gives
        point_data={key: value.astype(np.float32) for key, value in data.items()},
    )


def _body_lines(load: SurfacePressure) -> tuple[Array, Array, Array]:
    radius = float(np.sqrt(load.area / np.pi))
    on = load.pressure > 0
    lines = []
    for edges, axis in ((load.x, 1), (load.y, 0)):
        i = np.flatnonzero(on.any(axis=axis))
        low, high = edges[i[0]] - _BESIDE * radius, edges[i[-1] + 1] + _BESIDE * radius
        lines.append(np.linspace(low, high, 1 + int(np.ceil((high - low) / (_STEP * radius)))))
    # one step in depth is as the others at the depth of the maximum, half a radius
    share = np.linspace(0.0, 1.0, 1 + int(_DEEP / (1.5 * _STEP)))
    depth = radius * (SHALLOWEST + (_DEEP - SHALLOWEST) * share**1.5)
    return lines[0], lines[1], depth
