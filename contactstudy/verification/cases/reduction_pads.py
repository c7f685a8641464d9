"""The condensed rail in motion on pads with a length, against every node in motion."""

import numpy as np

from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.model import DiscreteSupports
from contactstudy.verification.cases.reduction import (
    SETTLED,
    SOURCE,
    SPEED,
    both_rails,
    third_octaves,
)
from contactstudy.verification.check import CaseResult, Check

MESH = CellRecipe(size=0.008, coarse=0.02, contact_half_width=0.016)
"""So coarse that the band of the full rail fits in memory: a pad couples all nodes above it."""
SHORTEST, HIGHEST = 4 * MESH.size, 2500.0
"""Shortest wave of the roughness in m, and the last third octave that it excites in Hz."""
ADDED, LEVEL = 0.001, 0.01
"""Bands: what the pads' length adds over the static load, and of each third octave."""

METHOD = """\
The passage of case `reduction` on the default supports, pads {pad:g} mm long, mesh of \
{size:g} mm, roughness from 400 to {shortest:g} mm, {reduced} dofs against {full}; and once \
more with pads without length. The third octaves are those of the contact force, condensed and full.

On this mesh most of what the two rails differ by lies at the passing of the slices, {ripple:.2g} \
kHz, where the residual flexibility has no inertia, with either pad. So the largest difference is \
reported, and what is judged is how much of it the pads' length adds: the largest change of the \
difference, condensed less full, from pads without length to the default ones, over the static \
load. The force itself changes by {changed:.2g} % of it."""


def passage_on_pads() -> CaseResult:
    """Default supports, half a minute and 2.3 GB."""
    support = DiscreteSupports()
    on_pads, point = (
        both_rails(MESH, DiscreteSupports(pad_length=length), SHORTEST)
        for length in (support.pad_length, 0.0)
    )
    settled, step = on_pads.time >= SETTLED, float(on_pads.time[1] - on_pads.time[0])
    differences = [(found.reduced - found.full)[settled] for found in (on_pads, point)]
    added = float(np.abs(differences[0] - differences[1]).max())
    checks = [
        Check("added by the pads' length", added, 0.0, "N", SOURCE, ADDED, scale=on_pads.static),
        *(
            Check(f"largest difference, pads {how}", float(np.abs(difference).max()), 0.0, "N",
                  SOURCE, None, scale=on_pads.static)
            for how, difference in zip(("with a length", "as points"), differences, strict=True)
        ),
    ]  # fmt: skip
    bands = [
        third_octaves(signal[settled], step, HIGHEST) for signal in (on_pads.reduced, on_pads.full)
    ]
    checks += [
        Check(f"third octave {f:g} Hz", float(np.sqrt(a)), float(np.sqrt(b)), "N", SOURCE, LEVEL)
        for f, a, b in zip(bands[0].nominal, *(b.mean_square for b in bands), strict=True)
    ]
    return CaseResult(
        name="reduction_pads",
        title="Condensed rail on pads with a length against every node in motion",
        method=METHOD.format(
            pad=1e3 * support.pad_length,
            size=1e3 * MESH.size,
            shortest=1e3 * SHORTEST,
            reduced=on_pads.dofs[0],
            full=on_pads.dofs[1],
            ripple=1e-3 * SPEED / MESH.thickness,
            changed=100
            * float(np.abs((on_pads.full - point.full)[settled]).max())
            / on_pads.static,
        ),
        checks=tuple(checks),
    )
