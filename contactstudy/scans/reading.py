"""Triangulated surfaces from STL, PLY and OBJ files, in metres."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.given_files import file_content
from contactstudy.profiles.orientation import Way, turned
from contactstudy.profiles.worn import Body
from contactstudy.scans.facing import wrong_axes
from contactstudy.scans.faults import faults

if TYPE_CHECKING:
    import trimesh

UNITS = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "um": 1e-6, "in": 25.4e-3}
"""Length units of a file, in m."""
MOST_TRIANGLES = 1_000_000
"""Of a scan."""
LARGEST = 2**28
"""Bytes of its file: text takes 250 a triangle, binary STL 50."""
Ways3 = tuple[Way, Way, Way]
OWN3: Ways3 = ("own", "own", "own")
SUFFIXES = (".stl", ".ply", ".obj")

#: What a rail head's or a wheel tread's size across (Y) and along (X) can be [m].
_SIZES = {
    "rail": ("a rail head", (0.02, 0.16), (0.01, 30.0)),
    "wheel": ("a wheel tread", (0.03, 0.25), (0.01, 1.5)),
}


def read_mesh(
    path: str | Path, unit: str, body: Body, ways: Ways3 = OWN3, tape: float = 0.0
) -> trimesh.Trimesh:
    """Surface [m] of an STL (text or binary), PLY or OBJ file, its equal vertices joined.

    All its parts together with their triangles, X along the rail, Y to the field side, Z up. The
    axes of the file point the `ways` stated, "own" ones as these. `tape` is Y of a wheel's tape
    circle [m].

    Raises
    ------
    InputError
        Listing everything that is wrong with the file: it is missing, unreadable or without
        triangles; values that are not finite; sizes that no rail head or tread has in this unit;
        and the faults of `contactstudy.scans.faults.faults`.
    """
    file = Path(path)
    if unit not in UNITS:
        raise InputError(f"{file}: unit is '{unit}'; allowed: {', '.join(UNITS)}")
    vertices, faces = _triangles(file)
    infinite = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(infinite):
        touched = np.flatnonzero(np.isin(faces, infinite).any(axis=1))
        raise InputError(
            f"{file}: {len(infinite)} vertices are not finite numbers, in {len(touched)} triangles "
            f"(the first: {', '.join(str(k) for k in touched[:3])})"
        )
    vertices, mirrored = turned(vertices, ways)
    mesh = _joined(vertices * UNITS[unit], faces[:, ::-1] if mirrored else faces)
    problems = _sizes(file, mesh.extents, unit, body)
    if problems:
        raise InputError(problems)
    points = np.asarray(mesh.vertices)
    if wrong := wrong_axes(points, np.asarray(mesh.faces), body, ways, tape):
        raise InputError(f"{file}: does not look like a {body}: {fault}" for fault in wrong)
    problems = [f"{file}: {fault}" for fault in faults(mesh, body, UNITS[unit], unit)]
    if problems:
        raise InputError(problems)
    return mesh


def _triangles(file: Path) -> tuple[Array, IntArray]:
    """Vertices in the file's unit and triangles."""
    import trimesh

    if file.suffix.lower() not in SUFFIXES:
        raise InputError(f"{file}: not a scan by its name; allowed: {', '.join(SUFFIXES)}")
    content, form = file_content(file, LARGEST), file.suffix[1:].lower()
    if form == "stl" and (fault := _stl_fault(content)):
        raise InputError(f"{file}: {fault}")
    try:
        with np.errstate(all="ignore"):  # what is not a number is looked for below
            # from memory, so that no file that it refers to is opened
            loaded = trimesh.load_scene(io.BytesIO(content), file_type=form, process=False)
            mesh = loaded.to_geometry() if len(loaded.geometry) else None
    except Exception as error:  # every reader of trimesh has its own kinds
        raise InputError(
            f"{file}: cannot be read as {form.upper()} (damaged, cut short, or another format?)"
        ) from error
    if not isinstance(mesh, trimesh.Trimesh) or len(mesh.faces) == 0:
        raise InputError(f"{file}: has no triangles; a scan must be triangulated, not points alone")
    if len(mesh.faces) > MOST_TRIANGLES:
        raise InputError(
            f"{file}: has {len(mesh.faces)} triangles; allowed: up to {MOST_TRIANGLES} (cut out "
            "the running surface, or make the mesh coarser)"
        )
    return np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.int64)


_HEADER, _TRIANGLE = 84, 50  # bytes of a binary STL


def _stl_fault(content: bytes) -> str:
    """What is wrong with the size of an STL file, "" where nothing is."""
    count = int.from_bytes(content[_HEADER - 4 : _HEADER], "little")
    asked = _HEADER + count * _TRIANGLE
    if len(content) >= _HEADER and len(content) == asked:
        return ""
    if content.lstrip()[:5].lower() == b"solid" and b"facet" in content[:2000].lower():
        ended = b"endsolid" in content[-2000:].lower()
        return "" if ended else "text STL without 'endsolid' at its end (cut short?)"
    if len(content) < _HEADER:
        return f"{len(content)} bytes are no STL; a binary one has a header of {_HEADER} bytes"
    why = "cut short?" if len(content) < asked else "bytes behind the last triangle?"
    return (
        f"binary STL of {len(content)} bytes; its header asks for {asked}, of {count} triangles "
        f"({why})"
    )


def _joined(vertices: Array, faces: IntArray) -> trimesh.Trimesh:
    """Mesh whose equal vertices are one: STL repeats them in every triangle."""
    import trimesh

    points, number = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    return trimesh.Trimesh(points, number.ravel()[faces], process=False)


def _sizes(file: Path, extents: Array, unit: str, body: Body) -> list[str]:
    """Complaints about sizes that are impossible in the unit."""
    what, across, along = _SIZES[body]

    def fits(factor: float) -> bool:
        return bool(
            across[0] <= extents[1] * factor <= across[1]
            and along[0] <= extents[0] * factor <= along[1]
        )

    if fits(1.0):
        return []
    fitting = [u for u, metres in UNITS.items() if fits(metres / UNITS[unit])]
    hint = f"; it would fit in {' or '.join(fitting)}" if fitting else ""
    return [
        f"{file}: with the unit {unit} it is {_length(extents[1])} wide (Y) and "
        f"{_length(extents[0])} long (X); {what} is {_length(across[0])} to "
        f"{_length(across[1])} wide and {_length(along[0])} to {_length(along[1])} long{hint}"
    ]


def _length(metres: float) -> str:
    return f"{metres:.4g} m" if metres >= 1.0 else f"{1e3 * metres:.4g} mm"
