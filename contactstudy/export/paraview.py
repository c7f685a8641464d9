"""Meshes and collections of them as files for ParaView."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import quoteattr

if TYPE_CHECKING:
    import meshio


class Piece(NamedTuple):
    """A file of a collection: its time [s], part and name of the part."""

    time: float
    part: int
    name: str
    file: str


def vtu(mesh: meshio.Mesh) -> bytes:
    """A mesh as a VTU file; meshio writes that by the file's name only."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.vtu"
        mesh.write(path, file_format="vtu")
        return path.read_bytes()


def collection(pieces: Sequence[Piece]) -> str:
    """Content of a PVD file, which opens all pieces with their times."""
    rows = [
        f'    <DataSet timestep="{one.time!r}" part="{one.part}" name={quoteattr(one.name)} '
        f"file={quoteattr(one.file)}/>"
        for one in pieces
    ]
    head = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', "  <Collection>"]
    return "\n".join([*head, *rows, "  </Collection>", "</VTKFile>"]) + "\n"
