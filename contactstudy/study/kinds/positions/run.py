"""Presses at all positions of a study, kept one by one; results as a dataset and as CSV."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.files import ensure_writable, writing
from contactstudy.geometry.wheelset import Side
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.provenance import provenance, versions
from contactstudy.reporter import Quiet, Reporter
from contactstudy.store import Store, digest, store_key
from contactstudy.study.kinds.positions.check import check_positions, pressings, roll_of
from contactstudy.study.kinds.positions.table import PositionsStudy
from contactstudy.study.results import RESULT_FILE

if TYPE_CHECKING:
    import xarray as xr

CSV_FILE = "patches.csv"
# name -> unit, meaning
VARIABLES = {
    "lateral": ("m", "lateral shift of the wheelset, to the right"),
    "yaw": ("rad", "yaw of the wheelset, clockwise seen from above"),
    "roll": ("rad", "roll of the wheelset, right side down"),
    "y": ("m", "contact position on the rail, to the field side"),
    "z": ("m", "contact position, up from the crown"),
    "x": ("m", "centre of pressure ahead of the axle"),
    "wheel_s": ("m", "centre of pressure on the wheel, arc length from the tape circle"),
    "angle": ("rad", "contact angle"),
    "normal_force": ("N", "normal force"),
    "vertical_force": ("N", "vertical force"),
    "approach": ("m", "largest overlap of the undeformed bodies along the normal"),
    "peak_pressure": ("Pa", "peak pressure"),
    "area": ("m^2", "area under pressure"),
    "along": ("m", "semi-axis along, of the ellipse with the pressure's second moments"),
    "across": ("m", "semi-axis across"),
}


def run_positions(
    study: PositionsStudy, out_dir: Path, reporter: Reporter | None = None
) -> xr.Dataset:
    """Press both wheels at every position; write result.nc and patches.csv.

    Positions that are finished in `out_dir` are not computed again.

    Parameters
    ----------
    study : PositionsStudy
    out_dir : Path
    reporter : Reporter, optional

    Returns
    -------
    xarray.Dataset
        One entry of the dimension ``row`` a contact patch, by wheel, position and falling force.

    Raises
    ------
    InputError
        Listing all positions that are impossible (`check_positions`), before any is pressed.
    NumericalError
        If a position cannot be pressed, with its place; those before it are kept.
    """
    reporter = reporter or Quiet()
    ensure_writable(out_dir)
    todo = pressings(study)
    store = Store(out_dir / "runs")
    kept = {one: store.load(_name(*one), _key(study, *one)) for one in todo}
    check_positions(study, [one for one, found in kept.items() if found.value is None], reporter)
    reporter.begin("positions", len(todo))
    rows = []
    for done, one in enumerate(todo):
        reporter.progress("positions", done, len(todo))
        if (found := kept[one].value) is None:
            found = _pressed(study, *one)
            store.save(_name(*one), _key(study, *one), found)
        rows += found
    reporter.end("positions", True)
    data = _dataset(study, rows)
    with writing(out_dir / RESULT_FILE) as path:
        data.to_netcdf(path, engine="h5netcdf")
    with writing(out_dir / CSV_FILE) as path:
        _write_csv(path, rows)
    return data


def _name(side: Side, k: int) -> str:
    return f"{side}_{k + 1:03d}"


def _key(study: PositionsStudy, side: Side, k: int) -> str:
    """Hash of everything that decides the patches of one wheel at one position."""
    settings = {
        key: v for key, v in study.config().items() if key not in ("lateral", "yaw", "roll")
    }
    profiles = [_curve_digest(c) for c in (study.wheelset.wheel, study.wheelset.rail)]
    return store_key([side, study.positions[k], settings, profiles], _pressed)


def _curve_digest(curve: ProfileCurve) -> str:
    s = np.linspace(*curve.s_range, 2001)
    return digest(np.asarray(curve.point(s)).tolist())


def _pressed(study: PositionsStudy, side: Side, k: int) -> list[dict[str, Any]]:
    shift, yaw, _ = study.positions[k]
    table, wheelset, turned = study.table, study.wheelset, roll_of(study, k)
    where = f"{side} wheel at {1e3 * shift:g} mm and {1e3 * yaw:g} mrad"
    try:
        placed = wheelset.geometry(side, shift, yaw, turned)
        press = press_wheel(placed, table.load, study.modulus, side=table.cell)
    except InputError as error:
        raise InputError([f"{where}: {problem}" for problem in error.problems]) from error
    except NumericalError as error:
        raise NumericalError(f"{where}: {error}") from error
    rows = []
    for number, p in enumerate(press.patches, start=1):
        row: dict[str, Any] = {"wheel": side, "position": k + 1, "patch": number}
        row |= {"lateral": shift, "yaw": yaw, "roll": turned}
        row |= {"y": p.reference.y - table.origin, "z": p.reference.z, "angle": p.reference.angle}
        names = [name for name in VARIABLES if name not in row]
        rows.append(row | {name: float(getattr(p, name)) for name in names})
    return rows


def _dataset(study: PositionsStudy, rows: list[dict[str, Any]]) -> xr.Dataset:
    import xarray as xr

    data = xr.Dataset()
    data["wheel"] = ("row", np.array([row["wheel"] for row in rows], dtype=object))
    for name in ("position", "patch"):
        data[name] = ("row", np.array([row[name] for row in rows], dtype=np.int64))
    for name, (unit, meaning) in VARIABLES.items():
        attrs = {"units": unit, "long_name": meaning}
        data[name] = ("row", np.array([float(row[name]) for row in rows]), attrs)
    key = store_key([study.config(), versions()], None)
    data.attrs = {
        "name": study.name,
        "title": study.title,
        "description": study.description,
        "config": json.dumps(study.config(), ensure_ascii=False),
        "units": json.dumps(study.table.units(), ensure_ascii=False),
        "provenance": json.dumps(provenance(None, key, None, {}), ensure_ascii=False),
    }
    return data


def _write_csv(path: Path, rows: list[dict[str, Any]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        names = ("wheel", "position", "patch", *VARIABLES)
        units = {name: unit for name, (unit, _) in VARIABLES.items()}
        writer.writerow([f"{n} [{units[n]}]" if n in units else n for n in names])
        writer.writerows([row[name] for name in names] for row in rows)
