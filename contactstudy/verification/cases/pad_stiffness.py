"""Static stiffness of a rail on pads with a length, against CalculiX on the same mesh."""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.dynamics.banded import Factor
from contactstudy.export.hexahedra import rail_hexahedra
from contactstudy.solids.bodies import rail_body
from contactstudy.solids.cache import cached
from contactstudy.track.model import DiscreteSupports, Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.verification.cases.pad_deck import (
    CELL,
    LOAD,
    REACH,
    SUPPORT,
    loaded_patch,
    pad_deck,
    read_stiffness,
    shares,
)
from contactstudy.verification.cases.run_calculix import calculix_version, solve_in
from contactstudy.verification.check import CaseResult, Check, ResultTable

BAYS, LOADED = 4, 2
"""Bays of the track, and the support at which the loaded half of a bay begins."""
PLACES = 7
BAND = 0.001

METHOD = """\
A patch of the running surface, {reach:g} mm long and four elements wide, carries {load:g} kN \
along its normal, spread like Hertz's pressure along the rail, at seven places from over a support \
to mid-bay. The rail is 60E1 over {bays} bays of {bay:g} m, clamped at both ends, mesh of \
{size:g} mm; pads {pad:g} mm long and the ballast are the defaults. The stiffness is the load over \
the displacement of the patch, weighted with the load; mid-bay is nearer to a clamped end, which \
makes it the stiffest place of this short track.

CalculiX keeps every node ({nodes}; incompatible-mode bricks, half a section). A pad is a spring \
on the mean vertical displacement of the foot over its footprint, by an equation over the foot's \
nodes whose weights are written down here once more; below it the ballast's spring. Ours is the \
chain of condensed cells with its residual flexibility, the mesh's own phase under the patch.

A pad without length is reported beside it: what the length does to the stiffness."""


def pad_stiffness() -> CaseResult:
    """The default supports."""
    version = calculix_version()
    track = _track(SUPPORT)
    mesh = rail_hexahedra(CELL, round(track.track.length / CELL.thickness))
    patches = [loaded_patch(mesh, x) for x in _places(track.track)]
    ours = [_stiffness(track, patch.x) for patch in patches]
    point = [_stiffness(_track(replace(SUPPORT, pad_length=0.0)), patch.x) for patch in patches]
    with tempfile.TemporaryDirectory() as name:
        results, _ = solve_in(Path(name), "\n".join(pad_deck(track.track, mesh, patches)) + "\n")
        theirs = read_stiffness(results, patches)
    at = [round(1e3 * (patch.x - LOADED * track.track.bay_length)) for patch in patches]
    checks = tuple(
        Check(
            f"stiffness {x} mm from a support", 1e-6 * a, 1e-6 * b, "kN/mm",
            f"CalculiX {version}", BAND,
        )
        for x, a, b in zip(at, ours, theirs, strict=True)
    )  # fmt: skip
    rows = tuple(
        (x, 1e-6 * b, 1e-6 * a, round(100 * (a / b - 1), 3), 1e-6 * c)
        for x, a, b, c in zip(at, ours, theirs, point, strict=True)
    )
    return CaseResult(
        name="pad_stiffness",
        title="Static stiffness over a bay, pads with a length, against CalculiX",
        method=METHOD.format(
            reach=2e3 * REACH,
            load=1e-3 * LOAD,
            bays=BAYS,
            bay=track.track.bay_length,
            size=1e3 * CELL.size,
            pad=1e3 * SUPPORT.pad_length,
            nodes=len(mesh.nodes),
        ),
        checks=checks,
        tables=(
            ResultTable(
                "Stiffness under the load, kN/mm.",
                ("from support (mm)", "CalculiX", "condensed", "difference (%)", "pads as points"),
                rows,
            ),
        ),
    )


def _track(support: DiscreteSupports) -> SolidTrack:
    track = Track(rail=solid_rail(CELL), support=support, length=BAYS * support.spacing)
    return SolidTrack(track, cached(rail_body(CELL)), mean_phase=False)


def _places(track: Track) -> Array:
    """X of the loads, on planes of the mesh."""
    x = track.bay_length * (LOADED + np.linspace(0.0, 0.5, PLACES))
    return np.asarray(CELL.thickness * np.round(x / CELL.thickness))


def _stiffness(track: SolidTrack, x: float) -> float:
    stretch = track.stretch(x, REACH)
    f = shares(stretch.x - x, stretch.y).ravel()
    load = np.zeros(track.n_dofs)
    np.add.at(load, stretch.dofs, stretch.map.T @ f)
    return 1 / float(load @ Factor(track.stiffness).solve(load) + f @ stretch.residual @ f)
