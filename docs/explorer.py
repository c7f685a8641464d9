"""The trust map as data of the page "Explorer".

    contactstudy run trust_map --out trust --sweep 'keep=["contact_force", "contact_force_smooth"]'
    python docs/explorer.py trust

writes ``docs/trust_map.json``, which is kept; the site's build makes the page's script of it.
"""

import json
import re
import sys
import tomllib
from pathlib import Path

import numpy as np
from contourpy import contour_generator

from contactstudy.figures.trust import AMPLITUDE, LEVELS, SPEED, WAVELENGTH, TrustMap, trust_map
from contactstudy.figures.trust_levels import limit_level, paper_level
from contactstudy.plot.text import label
from contactstudy.study.loading import find_study
from contactstudy.study.results import StudyResults, read_results

DATA = "trust_map.json"
_KEPT = "contact_force", "contact_force_smooth"
COMMAND = f"contactstudy run {{}} --out trust --sweep 'keep={json.dumps(_KEPT)}'"
_AXES = (SPEED, AMPLITUDE, WAVELENGTH)
_WAVES = 3
_POINTS = 60
"""Of a signal at least; it has up to twice as many."""
_COUNTS = 999
"""Of the largest value, in which signals are written."""


def compact(results: StudyResults) -> dict:
    """What the page shows of a finished trust map that kept the contact force.

    Lengths in m, speeds in m/s, errors in per cent; arrays over (run, speed, amplitude,
    wavelength), None where there is nothing.
    """
    found, data = trust_map(results), results.designs["sweep"]
    if found is None or not set(_KEPT) <= set(data):
        raise SystemExit(f"no trust map that kept {_KEPT}; run {COMMAND.format('...')}")
    return {
        "title": results.title,
        "command": COMMAND.format(results.name),
        "versions": results.provenance["versions"],
        "code": results.provenance["code"],
        "speeds": _rounded(data[SPEED].values, 8),
        "amplitudes": _rounded(data[AMPLITUDE].values, 8),
        "wavelengths": _rounded(data[WAVELENGTH].values, 8),
        "edges": _edges(found, data),
        "runs": {run: label(run) for run in found.runs},
        "reference": {results.reference: label(results.reference)},
        "errors": _rounded(found.errors.values),
        "own": None if found.own is None else _rounded(found.own.values),
        "refined": list(found.refined),
        "not_refined": [name for name in _refinable(results.name) if name not in found.refined],
        "lost": _rounded(found.lost.values, 1),
        "patch": _rounded(found.patch),
        "radius": found.radius,
        "failures": _failures(data),
        "signals": _signals(results, found),
        "study": study_of_a_cell(find_study(results.name).read_text("utf-8")),
    }


def study_of_a_cell(text: str) -> str:
    """The study file without axes, with WAVELENGTH, AMPLITUDE and SPEED to be filled in."""
    text = re.split(r"^\[(?:sweep|refine|quick)\]", text, flags=re.MULTILINE)[0].strip() + "\n"
    text = re.sub(r"^(title|description|companions) = (\"\"\".*?\"\"\"|.*?$)\n", "", text,
                  flags=re.MULTILINE | re.DOTALL)  # fmt: skip
    text = text.replace(
        'spectrum = "sinusoid"\n',
        'spectrum = "sinusoid"\nwavelength = "WAVELENGTH m"\namplitude = "AMPLITUDE m"\n',
    )
    text = text.replace("[journey]\n", '[journey]\nspeed = "SPEED m/s"\n')
    return f'title = "A cell of the trust map"\n{text}'


def _refinable(name: str) -> list[str]:
    """What the study's companions refine, computed or not."""
    study = tomllib.loads(find_study(name).read_text("utf-8"))
    files = [find_study(companion).read_text("utf-8") for companion in study["companions"]]
    keys = [key for file in files for key in tomllib.loads(file)["refine"] if "." in key]
    return [label(key.rpartition(".")[2]) for key in keys]


def _failures(data) -> list:
    return data["failure"].transpose(*_AXES).values.tolist()


def _edges(found: TrustMap, data) -> list:
    """Of the cells along wavelength and amplitude [m]; the map has other units."""
    axes = zip(
        found.edges, (found.wavelength, found.amplitude), (WAVELENGTH, AMPLITUDE), strict=True
    )
    return [_rounded(edges / own.at[0] * float(data[key][0])) for edges, own, key in axes]


def _signals(results: StudyResults, found: TrustMap) -> list:
    """Of each cell what the irregularity causes: X of the first and step [m], N, and counts."""
    data = results.designs["sweep"].transpose(*_AXES, "run", "sample", ...)
    runs = [results.reference, *found.runs]
    force, smooth = (data[name].sel(run=runs).values for name in _KEPT)
    position = data["position"].sel(run=results.reference).values
    cells = np.full(force.shape[:3], None, dtype=object)
    for cell in np.ndindex(cells.shape):
        x = position[cell]
        length = _WAVES * data[WAVELENGTH].values[cell[2]]
        inside = np.flatnonzero(x >= np.nanmax(x) - length) if np.isfinite(x).any() else []
        if len(inside) == 0:
            continue
        at = inside[:: max(1, len(inside) // _POINTS)]
        part = (force[cell] - smooth[cell])[:, at]
        count = max(np.nanmax(np.abs(part)), 1e-6) / _COUNTS
        cells[cell] = {
            "x": _rounded([x[at[0]], x[at[1]] - x[at[0]]], 8),
            "count": _rounded(count),
            "counts": np.rint(part / count).astype(int).tolist(),
        }
    return cells.tolist()


def script(data: dict) -> str:
    """The data as a script of the page, with contours and levels of railways."""
    axes = [np.array(data[name]) for name in ("wavelengths", "amplitudes")]
    errors = np.array(data["errors"], dtype=float)
    contours = [
        [{str(level): _contour(*axes, cells, level) for level in LEVELS} for cells in run]
        for run in errors
    ]
    shown = data | {
        "contours": contours,
        "limit": [_rounded(v) for v in limit_level()],
        "paper": [_rounded(v) for v in paper_level()],
    }
    return f"const TRUST = {json.dumps(shown, separators=(',', ':'))};\n"


def _contour(wavelengths: np.ndarray, amplitudes: np.ndarray, cells: np.ndarray, level: float):
    """Lines of one error; between the computed cells linear in the logarithms."""
    made = contour_generator(
        np.log(wavelengths), np.log(amplitudes), np.ma.masked_invalid(np.log(cells))
    )
    return [_rounded(np.exp(line).T) for line in made.lines(np.log(level))]


def _rounded(values, digits: int = 4):
    """Numbers, or nested lists of them, with so many digits; None in place of nan."""
    if isinstance(values, list | tuple | np.ndarray):
        return [_rounded(v, digits) for v in values]
    return float(f"{values:.{digits}g}") if np.isfinite(values) else None


if __name__ == "__main__":
    made = compact(read_results(sys.argv[1]))
    path = Path(__file__).parent / DATA
    path.write_text(json.dumps(made, separators=(",", ":")) + "\n", "utf-8")
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")
