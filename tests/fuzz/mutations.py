"""Seeded faults of study files, tables of numbers, and meshes: each changes files in a folder."""

import os
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
import trimesh
from bases import FILES

VALUES = (
    "0", "-1", "-0.0", "1e-300", "1e300", "1e999", "nan", "inf", "-inf", "12345678901234567890",
    "true", "[]", "{}", '""', '"x"', '"1e9999 m"', '"-3 m"', '"3 parsec"', '"3 km/h"', '"3 m^9^9"',
    '"１２ m"', '"3,5 m"', '"3 kg m^2/s^3"', "[1, 2]", "[[[[1]]]]", '["a", "b"]', '"\\u0000"',
    "1979-05-27", "0x10", "1_000", '"NaN m"', "9" * 5000, '"' + "m" * 5000 + '"',
)  # fmt: skip
CELLS = (
    "", "nan", "inf", "-999", "1e308", "-1e308", "1e-308", "1_0", "３", "0x1", "1,5", "--1", '"',
    "\t", "true", "1e5", "-1e5", "1" * 400,
)  # fmt: skip

Mutation = Callable[[Path, str, Random], None]


def value(folder: Path, study: str, random: Random) -> None:
    """A key has another value."""
    lines = _text(folder, study)
    k = random.choice([k for k, line in enumerate(lines) if "=" in line])
    lines[k] = f"{lines[k].split('=')[0]}= {random.choice(VALUES)}"
    _write(folder, study, lines)


def unit(folder: Path, study: str, random: Random) -> None:
    """A number is a thousand or a million times another, or its unit is."""
    lines = _text(folder, study)
    k = random.choice([k for k, line in enumerate(lines) if '= "' in line or "= " in line])
    swaps = (" mm", " m"), (" m", " mm"), (" m", " km"), ("km/h", "m/s"), (" kN", " N"), (
        " kg", " t"), ("GN", "N"), (" m", " kg"), (" m", " s"), ("1", "1000")  # fmt: skip
    for old, new in random.sample(swaps, len(swaps)):
        if old in lines[k]:
            lines[k] = lines[k].replace(old, new, 1)
            break
    _write(folder, study, lines)


def line(folder: Path, study: str, random: Random) -> None:
    """A line is missing, twice, moved, or cut."""
    lines = _text(folder, study)
    k = random.randrange(len(lines))
    what = random.randrange(5)
    if what == 0:
        del lines[k]
    elif what == 1:
        lines.insert(k, lines[k])
    elif what == 2:
        lines.insert(random.randrange(len(lines)), lines.pop(k))
    elif what == 3:
        lines[k] = lines[k][: random.randrange(len(lines[k]) + 1)]
    else:
        lines[k] = random.choice(
            ("[runs.x]", "[nowhere]", "a = 1", "[[track]]", "x" * 3000, "[" * 300, "a.b.c.d = 2",
             "\ufeff", "[sweep]\n\"track.length\" = [1, 2]", "=", "'''")
        )  # fmt: skip
    _write(folder, study, lines)


def encoding(folder: Path, study: str, random: Random) -> None:
    """The file is in another encoding, has marks, zeros, or ends early."""
    file = _any(folder, study, random)
    content = file.read_bytes()
    what = random.randrange(8)
    if what < 3:
        name = ("utf-16", "utf-8-sig", "utf-32")[what]
        content = content.decode("utf-8", "replace").encode(name)
    elif what == 3:
        content = content[: random.randrange(len(content))]
    elif what == 4:
        at = random.randrange(len(content))
        content = (
            content[:at] + random.choice((b"\0", b"\xff\xfe", b"\x1b[2J", b"\r")) + content[at:]
        )
    elif what == 5:
        content = content.replace(b"\n", b"\r\n") + b"\x1a"
    elif what == 6:
        content = random.choice((b"", b"\n", b"\0" * 1000, random.randbytes(2000)))
    else:
        at = random.randrange(len(content))
        content = content[:at] + random.randbytes(random.randrange(1, 40)) + content[at + 20 :]
    file.write_bytes(content)


def place(folder: Path, study: str, random: Random) -> None:
    """A file is a folder, a pipe, a loop, not there, or not to be read."""
    file = _any(folder, study, random)
    file.unlink()
    what = random.randrange(5)
    if what == 0:
        file.mkdir()
    elif what == 1:
        os.mkfifo(file)
    elif what == 2:
        file.symlink_to(file)
    elif what == 3:
        file.symlink_to("/dev/zero")


def cell(folder: Path, study: str, random: Random) -> None:
    """One or several cells of a table hold something else."""
    file, rows = _rows(folder, study, random)
    for _ in range(random.choice((1, 1, 1, 5, 50))):
        row = rows[random.randrange(1, len(rows))]
        row[random.randrange(len(row))] = random.choice(CELLS)
    _save(file, rows)


def scaled(folder: Path, study: str, random: Random) -> None:
    """A column is in another unit, mirrored, moved, constant, or noise."""
    file, rows = _rows(folder, study, random)
    k = random.randrange(len(rows[0]))
    factor = random.choice((1e-6, 1e-3, 25.4, 1e3, 1e6, -1.0, 0.0))
    offset = random.choice((0.0, 0.0, 1.0, -100.0, 1e6))
    noise = random.choice((0.0, 0.0, 1e-3, 0.1, 10.0))
    for row in rows[1:]:
        row[k] = f"{factor * float(row[k]) + offset + noise * random.gauss(0.0, 1.0):.9g}"
    _save(file, rows)


def order(folder: Path, study: str, random: Random) -> None:
    """Rows are shuffled, reversed, twice, missing, too few, too wide; columns are swapped."""
    file, rows = _rows(folder, study, random)
    head, body = rows[0], rows[1:]
    k = random.randrange(len(body) - 5)
    what = random.randrange(9)
    if what == 0:
        random.shuffle(body)
    elif what == 1:
        body.reverse()
    elif what == 2:
        body[k:k] = body[k : k + random.randrange(1, 5)]
    elif what == 3:
        del body[k : k + random.randrange(1, 40)]
    elif what == 4:
        body = body[: random.randrange(6)]
    elif what == 5:
        body = [row[::-1] for row in body]
    elif what == 6:
        body[k].append("7")
    elif what == 7:
        head = random.choice((head[::-1], head[:1] * 2, ["a", "b", "c"], [], head[:1]))
    else:
        body[k] = body[k][:1]
    _save(file, [head, *body])


def separator(folder: Path, study: str, random: Random) -> None:
    """Another program's separators."""
    file, rows = _rows(folder, study, random)
    comma, between = random.choice(((",", ";"), (".", ";"), (".", "\t"), (".", " "), (",", ",")))
    text = "\n".join(between.join(c.replace(".", comma) for c in row) for row in rows)
    file.write_text(text + "\n", "utf-8")


def facets(folder: Path, study: str, random: Random) -> None:
    """Facets are gone, turned over, twice, without area, or joined at random."""
    file, vertices, faces = _mesh(folder, study, random)
    n = len(faces)
    some = np.array(random.sample(range(n), random.choice((1, 10, n // 3))))
    what = random.randrange(6)
    if what == 0:
        faces = np.delete(faces, some, axis=0)
    elif what == 1:
        faces[some] = faces[some][:, ::-1]
    elif what == 2:
        faces = np.vstack([faces, faces[some]])
    elif what == 3:
        faces[some, 1] = faces[some, 0]
    elif what == 4:
        faces[some] = np.array([[random.randrange(len(vertices)) for _ in range(3)] for _ in some])
    else:
        faces = faces[: random.choice((0, 1, 5))]
    trimesh.Trimesh(vertices, faces, process=False).export(file)


def points(folder: Path, study: str, random: Random) -> None:
    """Vertices are turned, mirrored, scaled, moved, scattered, flat, or no numbers."""
    file, vertices, faces = _mesh(folder, study, random)
    what = random.randrange(8)
    if what == 0:
        vertices = vertices[:, random.sample(range(3), 3)]
    elif what == 1:
        vertices = vertices * [random.choice((1, -1)) for _ in range(3)]
    elif what == 2:
        vertices = vertices * random.choice((1e-6, 1e-3, 0.1, 10.0, 1e3, 1e12))
    elif what == 3:
        vertices = vertices + [random.choice((0.0, 100.0, 1e5, 1e9)) for _ in range(3)]
    elif what == 4:
        sigma = random.choice((0.01, 0.1, 1.0, 100.0))
        vertices = vertices + np.random.default_rng(random.randrange(99)).normal(
            0, sigma, vertices.shape
        )
    elif what == 5:
        vertices[:, random.randrange(3)] = random.choice((0.0, 1e30))
    elif what == 6:
        vertices[random.randrange(len(vertices)), random.randrange(3)] = random.choice(
            (np.nan, np.inf, 1e38)
        )
    else:
        angle = random.uniform(0.05, 3.0)
        c, s = np.cos(angle), np.sin(angle)
        vertices = vertices @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    with np.errstate(all="ignore"):
        trimesh.Trimesh(vertices, faces, process=False).export(file)


TEXT: tuple[Mutation, ...] = (value, value, unit, line, encoding, place)
TABLE: tuple[Mutation, ...] = (cell, scaled, order, separator)
MESH: tuple[Mutation, ...] = (facets, points)
OF_STUDY: dict[str, tuple[Mutation, ...]] = {
    "plain": TEXT,
    "level": (*TEXT, *TABLE, *TABLE),
    "defect": (*TEXT, *TABLE),
    "profiles": (*TEXT, *TABLE, *TABLE),
    "scan": (*TEXT, *MESH, *MESH),
}
"""Name of a study -> what may happen to it."""


def _text(folder: Path, study: str) -> list[str]:
    return (folder / f"{study}.toml").read_text("utf-8").splitlines()


def _write(folder: Path, study: str, lines: list[str]) -> None:
    (folder / f"{study}.toml").write_text("\n".join(lines) + "\n", "utf-8")


def _any(folder: Path, study: str, random: Random) -> Path:
    return folder / random.choice((f"{study}.toml", *FILES[study]))


def _rows(folder: Path, study: str, random: Random) -> tuple[Path, list[list[str]]]:
    file = folder / random.choice(FILES[study])
    return file, [row.split(",") for row in file.read_text("utf-8").splitlines()]


def _save(file: Path, rows: list[list[str]]) -> None:
    file.write_text("\n".join(",".join(row) for row in rows) + "\n", "utf-8")


def _mesh(folder: Path, study: str, random: Random) -> tuple[Path, np.ndarray, np.ndarray]:
    file = folder / random.choice(FILES[study])
    mesh = trimesh.load_mesh(file, process=False)
    return file, np.array(mesh.vertices, dtype=float), np.array(mesh.faces)
