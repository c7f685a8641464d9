"""Short waves: the best point contact against surface contact with the same modal wheel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity import Irregularity
from contactstudy.plot.curves import Plot, curve
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.kinds.passage.twins import twins
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.track.receptance import receptance
from contactstudy.verification.check import CaseResult, Check, ResultTable

MESH, COARSER = 0.0014, 0.002
SPEEDS = (100.0, 300.0)
"""km/h"""
AMPLITUDES = {0.1: 10e-6, 0.05: 10e-6, 0.03: 5e-6, 0.02: 5e-6}
"""Wavelength in m -> amplitude in m."""
BAND = {100.0: 0.05, 300.0: 0.10}
"""What the best scheme is to keep at each speed."""
BEAM, BEST = "press, patch, bay", "press, patch, meshed rail"
STEPS = 40  # a wave
_START, _FADE, _LENGTH = 4.8, 0.3, 1.2  # m
_BEAM = PointRun(rail="timoshenko", local_compliance=True, k_r="tangent", wheel="modal")
_PRESS = PointRun(law="press", contact_filter="patch", patch_filter="following", wheel="modal")
_RUNS: dict[str, PointRun | SurfaceRun] = {
    "surface": SurfaceRun(wheel="modal"),
    "tangent": _BEAM,
    "tangent, sin(ka)/(ka)": replace(_BEAM, contact_filter="patch", patch_weight="hertz"),
    "tangent, patch": replace(_BEAM, contact_filter="patch"),
    BEAM: replace(
        _PRESS,
        rail="timoshenko",
        local_compliance=True,
        bay_compliance=True,
        elements_per_bay=8,
    ),
    BEST: replace(_PRESS, rail="solid"),
}
METHOD = (
    "A wheel runs over a sinusoidal irregularity on the default track, by surface contact with a "
    "modal wheel and by point contacts on a Timoshenko beam with local compliance and the same "
    f"modes of the wheel. Waves of 20 and 30 mm have an amplitude of 5 µm, the others 10 µm; "
    f"{STEPS} steps a wave, meshes of {1e3 * MESH:g} mm. What the irregularity causes is the force "
    "less that of the same run on the smooth rail, over two bays after the fade-in; its relative "
    "L2 difference from surface contact is given.\n\n"
    "The plain spring feels the wave as it is; the filter feels its mean over the patch of Hertz, "
    "or with the weights of the press. The best scheme on a beam has the press itself as law, a "
    "patch that follows the load, the give of the meshed rail over a bay, and 8 elements a bay. "
    "The best of all has the same contact at a point of the meshed rail.\n\n"
    "At 300 km/h the waves of 30 and 20 mm pass with 2.8 and 4.2 kHz. There the rail's section "
    "deforms and its head vibrates on the web, which a beam's does not: the second table has the "
    "resonances of the track with nodes at the supports, one and two half waves a bay. The last "
    "column is the difference that the mesh of surface contact makes itself, 2 mm against 1.4 mm."
)


def short_waves() -> CaseResult:
    """Sinusoids of 20 to 100 mm at 100 and 300 km/h."""
    found = {(v, w): _differences(v, w) for v in SPEEDS for w in AMPLITUDES}
    columns = [*[name for name in _RUNS if name != "surface"], "surface, 2 mm"]
    checks = [
        Check(
            f"{BEST}: {1e3 * w:g} mm at {v:g} km/h",
            off[BEST],
            BAND[v],
            "",
            "limit; surface contact",
            0.0,
            "at_most",
        )
        for (v, w), off in found.items()
    ]
    rows = tuple(
        (v, 1e3 * w, *(round(100 * off[name], 1) for name in columns))
        for (v, w), off in found.items()
    )
    header = ("speed (km/h)", "wavelength (mm)", *(f"{name} (%)" for name in columns))
    waves = 1e3 * np.array(list(AMPLITUDES))
    plots = tuple(
        Plot(
            f"Difference of what the irregularity causes in the contact force, {v:g} km/h.",
            "wavelength (mm)",
            "difference (%)",
            tuple(
                curve(name, waves, np.array([100 * found[v, w][name] for w in AMPLITUDES]), "both")
                for name in columns
            ),
            "log",
            "log",
        )
        for v in SPEEDS
    )
    title = "Short waves, point contact against surface contact"
    caption = "Relative L2 difference of what the irregularity causes in the contact force."
    table = ResultTable(caption, header, rows)
    return CaseResult("short_waves", title, METHOD, tuple(checks), (table, _resonances()), plots)


def _resonances() -> ResultTable:
    """Pinned-pinned resonances of the beam and of the meshed rail."""
    study = _study(SPEEDS[0], 0.1, COARSER, _RUNS)
    track = build.track(study)
    beam = BeamTrack(track, "timoshenko", 8, element_compliance=True)
    meshed = build.solid_track(study, track)
    rows = []
    # where a bay with nodes at its ends moves most
    for waves, share, low in ((1, 0.5, 1000.0), (2, 0.25, 2700.0)):
        x, tried = (
            track.middle + (0.5 - share) * track.bay_length,
            np.linspace(low, low + 245.0, 50),
        )
        peaks = [float(tried[np.abs(receptance(r, x, tried)).argmax()]) for r in (beam, meshed)]
        rows.append((waves, *peaks))
    header = ("half waves a bay", "beam (Hz)", "meshed rail (Hz)")
    return ResultTable("Pinned-pinned resonances of the track.", header, tuple(rows))


def _differences(speed: float, wavelength: float) -> dict[str, float]:
    """Of each run from surface contact."""
    study = _study(speed, wavelength, MESH, _RUNS)
    exact = _caused(study, "surface")
    found = {run: _caused(study, run) for run in _names(_RUNS) if run != "surface"}
    coarser = _caused(_study(speed, wavelength, COARSER, {"surface": _RUNS["surface"]}), "surface")
    found |= {"surface, 2 mm": coarser}
    size = np.linalg.norm(exact)
    titles = dict(zip(_names(_RUNS), _RUNS, strict=True))
    return {
        titles.get(run, run): float(np.linalg.norm(force - exact) / size)
        for run, force in found.items()
    }


def _names(runs: dict[str, PointRun | SurfaceRun]) -> list[str]:
    """Names that runs may have: "surface", "r1", "r2" ..."""
    return ["surface", *(f"r{k}" for k in range(1, len(runs)))]


def _study(
    speed: float, wavelength: float, mesh: float, runs: dict[str, PointRun | SurfaceRun]
) -> Study:
    step = min(wavelength / STEPS / (speed / 3.6), 2.5e-5)
    steps = int(np.ceil((_FADE + _LENGTH) / (step * speed / 3.6)))
    named = dict(zip(_names(runs), runs.values(), strict=True))
    return Study(
        name="short_waves",
        title="Short waves",
        irregularity=Irregularity(
            spectrum="sinusoid", wavelength=wavelength, amplitude=AMPLITUDES[wavelength]
        ),
        track=Track(length=12.0),
        journey=Journey(
            _START, _START + steps * step * speed / 3.6, speed / 3.6, step, fade_in=_FADE
        ),
        solid=Solid(mesh_size=mesh),
        runs=named,
        smooth=True,
    )


def _caused(study: Study, run: str) -> Array:
    """Contact force in N that the irregularity causes after the fade-in."""
    rough, smooth = execute_run(study, run), execute_run(study, twins(study)[run])
    late = np.ravel(rough.position) >= _START + _FADE
    return np.asarray(np.ravel(rough.contact_force) - np.ravel(smooth.contact_force))[late]
