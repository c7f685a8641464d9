"""Points of profiles as the field's programs write them: MiniProf, Simpack and plain text.

MiniProf (``.ban`` rail, ``.whl`` wheel; mm): a header, an empty line, one point a line. Simpack
(``.prr`` rail, ``.prw`` wheel): points between ``point.begin`` and ``point.end``, lengths
divided by ``units.len.f``. Plain text (``.txt``, ``.dat``, ``.asc``; mm): two columns. Of a line
the first two numbers count; what follows them is a weight, an angle or a remark. Lines behind a
quotation mark, ``!``, ``#``, ``%`` or ``;`` are disabled.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.csv_rows import finite_number, listed
from contactstudy.exceptions import InputError
from contactstudy.given_files import file_text

MINIPROF, SIMPACK, PLAIN = (".ban", ".whl"), (".prr", ".prw"), (".txt", ".dat", ".asc")
SUFFIXES = (*MINIPROF, *SIMPACK, *PLAIN)
#: The body that a suffix stands for.
BODY = {".ban": "rail", ".prr": "rail", ".whl": "wheel", ".prw": "wheel"}
FOLD = 5e-5
"""How far points may go back [m]: they are left out; a caliper's lifting is longer."""
STEEP = np.tan(np.deg2rad(85.0))
"""Slope above which the ends, vertical faces that nothing rolls on, are left out."""

_COMMAS = re.compile(r"\s*[-+]?\d*,\d+[\s;]+[-+]?\d*,\d+\s*([;\s]|$)")
_DISABLED = ('"', "!", "#", "%", ";", "//")
# a wheel's mirroring, and z of both, are found by the shape
_NOT_APPLIED = {
    "rail": ("shift.y", "shift.z", "rotate", "mirror.y"),
    "wheel": ("shift.y", "shift.z", "rotate"),
}

# what a header may state besides, of which nothing is done: MiniProf's (in lower case), Simpack's
_MOVES = ("xoffset", "yoffset", "tilt")
_SMOOTHED = ("approx.smooth", "point.dist.min")


@dataclass(frozen=True)
class FilePoints:
    """Points (n, 2) = (y, z) [m] in the file's axes with their lines, and what was left out."""

    points: Array
    lines: list[int]
    notes: list[str]


def read_points(path: Path, body: str) -> FilePoints:
    """Points of a file of one of `SUFFIXES` along which y grows or falls.

    Raises
    ------
    InputError
        For the other body's file, a cut one, fewer points than the header counts, lines without
        two numbers, transformations that are not applied, and points that go back by more than
        `FOLD`.
    """
    suffix = path.suffix.lower()
    if BODY.get(suffix, body) != body:
        raise InputError(f"{path}: is the profile of a {BODY[suffix]} by its name, not of a {body}")
    rows = list(enumerate(file_text(path, "profile", "latin-1").split("\n"), 1))
    problems: list[str] = []
    ignored: list[str] = []
    counted, factor = None, 1e-3
    if suffix in SIMPACK:
        rows, factor = _simpack(path, rows, body, problems, ignored)
    elif suffix in MINIPROF:
        rows, counted = _miniprof(path, rows, ignored)
    points, lines, faults, disabled = _numbers(rows)
    problems += listed(path, faults)
    if counted is not None and len(lines) + disabled < counted:
        problems.append(
            f"{path}: {len(lines) + disabled} points; its header counts {counted} (cut short?)"
        )
    if problems:
        raise InputError(problems)
    notes = [f"{path.name}: {text}, which is not applied" for text in ignored]
    notes += [f"{path.name}: {disabled} disabled lines left out"] if disabled else []
    if counted is not None and len(lines) > counted:
        notes.append(f"{path.name}: {len(lines)} points read; its header counts {counted}")
    return _walk(path, FilePoints(points * factor, lines, notes))


Rows = list[tuple[int, str]]


def _miniprof(path: Path, rows: Rows, ignored: list[str]) -> tuple[Rows, int | None]:
    """Rows of points and how many the header counts; adds what it states besides."""
    begin = next(
        (k + 1 for k, (_, text) in enumerate(rows[:-1]) if not text.strip() and _pair(rows[k + 1])),
        None,
    )
    if begin is None:
        raise InputError(f"{path}: no points behind an empty line; is it a MiniProf file?")
    header = [match for _, text in rows[:begin] if (match := re.match(r"\s*(\w+)=(.*)", text))]
    values = {match[1].lower(): match[2].strip() for match in header}
    columns = values.get("columndef", "X,Y").upper()
    if not columns.startswith("X,Y"):
        raise InputError(f"{path}: ColumnDef={columns}; allowed: X,Y first")
    moved = {name: text for name in _MOVES if (text := values.get(name))}
    ignored += [f"{name} = {text}" for name, text in moved.items() if finite_number(text) != 0.0]
    count = values.get("xypoints", "")
    return rows[begin:], int(count) if re.fullmatch("[0-9]{1,7}", count) else None


def _simpack(
    path: Path, rows: Rows, body: str, problems: list[str], ignored: list[str]
) -> tuple[Rows, float]:
    """Rows of points, and metres a unit of length; adds what is wrong and what is not applied."""
    bare = [text.split("!")[0].strip() for _, text in rows]
    if "point.begin" not in bare or "point.end" not in bare:
        missing = "point.end" if "point.begin" in bare else "point.begin"
        raise InputError(f"{path}: there is no line '{missing}' (cut short?)")
    if bare.count("point.begin") > 1:
        problems.append(
            f"{path}: {bare.count('point.begin')} lines 'point.begin'; allowed: one block of points"
        )
    begin, end = bare.index("point.begin"), bare.index("point.end")
    found = [match for text in bare[:begin] if (match := re.match(r"([\w.]+)\s*=\s*(\S+)", text))]
    texts = {match[1]: match[2] for match in found if match[1] != "type"}
    values = {name: finite_number(text) for name, text in texts.items()}
    kinds = [match[2] for match in found if match[1] == "type"]
    if kinds and kinds[0] != {"rail": "0", "wheel": "1"}[body]:
        problems.append(f"{path}: type = {kinds[0]}; allowed: 0 for a rail, 1 for a wheel")
    problems += [
        f"{path}: {name} = {values[name]:g}; allowed: 0 (it would not be applied)"
        for name in _NOT_APPLIED[body]
        if values.get(name)
    ]
    units = values.get("units.len.f", 1e3)
    if not units or units <= 0.0:
        problems.append(
            f"{path}: units.len.f = {texts['units.len.f']}; allowed: a number above 0, units of "
            "length a metre"
        )
        units = 1e3
    ignored += [f"{name} = {values[name]:g}" for name in _SMOOTHED if values.get(name)]
    for axis in ("y", "z"):
        low, high = (values.get(f"bound.{axis}.{end}") for end in ("min", "max"))
        if low is not None and high is not None and low < high:
            ignored.append(f"bound.{axis} = {low:g} to {high:g}")
    return rows[begin + 1 : end], 1.0 / units


def _pair(row: tuple[int, str]) -> bool:
    """Whether a row holds a point, enabled or not."""
    return next(_read([(row[0], row[1].lstrip(' "'))]), (0, None))[1] is not None


def _read(rows: Rows) -> Iterator[tuple[int, list[float] | None]]:
    """Line and the first two numbers of each row that is not blank; None where there are none."""
    for line, text in rows:
        cells = re.split(r"[\s,;\t]+", text.strip(), maxsplit=2)[:2]
        values = [None if _COMMAS.match(text) else finite_number(cell) for cell in cells]
        if text.strip():
            good = [value for value in values if value is not None]
            yield line, good if len(good) == 2 else None


def _numbers(rows: Rows) -> tuple[Array, list[int], list[str], int]:
    """Points, their lines, faults, and the number of disabled points."""
    enabled = [(k, text) for k, text in rows if not text.strip().startswith(_DISABLED)]
    disabled = sum(_pair((k, t)) for k, t in rows if t.strip().startswith('"'))
    points, lines, faults = [], [], []
    for line, values in _read(enabled):
        if values is None:
            faults.append(
                f"line {line}: does not begin with two numbers, which have decimal points"
            )
        else:
            points.append(values)
            lines.append(line)
    return np.array(points, dtype=float).reshape(-1, 2), lines, faults, disabled


def _walk(path: Path, read: FilePoints) -> FilePoints:
    """Without vertical faces at the ends and short steps back."""
    p, lines = read.points, np.array(read.lines)
    if len(p) < 3:
        return read
    sign = 1.0 if p[-1, 0] > p[0, 0] else -1.0
    steep = sign * np.diff(p[:, 0]) * STEEP < np.abs(np.diff(p[:, 1]))
    low = int(np.argmin(steep)) if not steep.all() else 0
    high = len(p) - (int(np.argmin(steep[::-1])) if not steep.all() else 0)
    p, lines = p[low:high], lines[low:high]
    y = sign * p[:, 0]
    reached = np.maximum.accumulate(y)
    back = np.concatenate([[False], y[1:] <= reached[:-1]])
    far = np.flatnonzero(reached - y > FOLD)
    problems = listed(
        path,
        [
            f"line {lines[k]}: y = {1e3 * p[k, 0]:g} mm goes back by "
            f"{1e3 * (reached[k] - y[k]):.3g} mm; allowed: up to {1e3 * FOLD:g} mm"
            for k in far
        ],
    )
    if problems:
        raise InputError(problems)
    notes = [*read.notes]
    if back.any():
        notes.append(
            f"{path.name}: {back.sum()} points that repeat or go back left out, the first in line "
            f"{lines[back][0]}"
        )
    return FilePoints(p[~back], [int(k) for k in lines[~back]], notes)
