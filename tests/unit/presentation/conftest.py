"""Made-up results with the shape of real ones, so that figures and report need no solver."""

import copy

import numpy as np
import pytest
import xarray as xr

from contactstudy.irregularity.shown import IrregularityInfo, Level, SpectrumCurve, to_dataset
from contactstudy.study.kinds.passage.metrics import study_metrics
from contactstudy.study.results import StudyResults

SPEED, DT, STATIC = 300 / 3.6, 1e-4, 67.4e3

UNITS = {
    "track.length": "m",
    "track.youngs_modulus": "Pa",
    "track.spacing": "m",
    "track.pad_stiffness": "N/m",
    "track.pad_damping": "N*s/m",
    "vehicle.static_load": "N",
    "vehicle.wheel_radius": "m",
    "journey.from": "m",
    "journey.to": "m",
    "journey.speed": "m/s",
    "journey.time_step": "s",
    "journey.fade_in": "m",
    "irregularity.band": "rad/m",
    "solid.mesh_size": "m",
    "solid.cell_length": "m",
    "solid.penalty": "Pa/m",
    "runs.point.k_r": "N/m",
}
CONFIG = {
    "irregularity": {"spectrum": "paper", "seed": 1, "terms": 1000, "band": [0.08, 20.0]},
    "track": {
        "length": 36.0,
        "rail": "60E1",
        "youngs_modulus": 210e9,
        "poisson_ratio": 0.3,
        "support": "discrete",
        "layer": "ballast",
        "spacing": 0.6,
        "pad_stiffness": 65e6,
        "pad_damping": 75e3,
    },
    "vehicle": {"type": "wheel_column", "static_load": STATIC, "wheel_radius": 0.43},
    "journey": {"from": 6.0, "to": 30.0, "speed": SPEED, "time_step": 5e-5, "fade_in": 3.0},
    "solid": {"mesh_size": 0.002, "cell_length": 0.1, "penalty": 1e16},
    "runs": {
        "surface": {"solver": "surface"},
        "hertz_timoshenko": {"solver": "point", "rail": "timoshenko", "law": "hertz"},
        "point": {
            "solver": "point",
            "rail": "euler",
            "law": "linear",
            "k_r": 1e11,
            "elements_per_bay": 4,
        },
        "tangent": {
            "solver": "point",
            "rail": "euler",
            "law": "linear",
            "k_r": "tangent",
            "elements_per_bay": 4,
        },
    },
    "compare": {"reference": "surface"},
}


def paper_density(w):
    return 0.8e-7 / (w**2 * (w**2 + 1))


def made_run(k, rough, name):
    rng = np.random.default_rng(7)
    time = np.arange(0, 24.0 / SPEED + DT / 2, DT)
    x = 6.0 + SPEED * time
    w = 0.08 + (np.arange(200) + 0.5) * 0.0996
    phases = rng.uniform(0, 2 * np.pi, 200)
    a = 2 * np.sqrt(paper_density(w) * 0.0996)
    r = np.cos(np.outer(x, w) + phases) @ a
    fade = np.clip((x - 6.0) / 3.0, 0, 1)
    r = r * (3 * fade**2 - 2 * fade**3) * rough
    dynamic = np.cos(np.outer(x, w) + phases + 0.02 * k) @ (a * w**2 * (1 + 0.03 * k))
    passing = 350.0 * np.cos(2 * np.pi * x / 0.6) + 40 * np.cos(2 * np.pi * x / 0.15 + k)
    force = STATIC + 6e5 * dynamic * fade * rough + passing * (1 + 0.1 * k)

    def signal(v, unit, text):
        return ("time", v, {"units": unit, "long_name": text})

    data = xr.Dataset(
        {
            "contact_force": signal(force, "N", "contact force"),
            "wheel_displacement": signal(r * 0.9 - 0.8e-3, "m", "wheel displacement"),
            "wheel_acceleration": signal((STATIC - force) / 890, "m/s^2", "wheel acceleration"),
            "rail_displacement": signal(-force / STATIC * 0.7e-3, "m", "rail displacement"),
            "rail_acceleration": signal((force - STATIC) / 60, "m/s^2", "rail acceleration"),
            "irregularity": signal(r, "m", "irregularity"),
        },
        coords={"time": time, "position": ("time", x)},
        attrs={
            "solver": "surface" if name == "surface" else "point",
            "dofs": 5300 if name == "surface" else 730,
            "steps": len(time) - 1,
            "dt": DT,
            "static_force": STATIC,
        },
    )
    if name == "surface":
        data = add_patch(data, force, x)
        data = add_sections(data)
    return data


def add_patch(data, force, x):
    area = np.pi * 5.84e-3 * 4.6e-3 * (force / 60e3) ** (2 / 3)
    data["contact_area"] = ("time", area, {"units": "m^2"})
    data["peak_pressure"] = ("time", 1.5 * force / area, {"units": "Pa"})
    gx, gy = np.meshgrid(np.arange(-12, 13) * 1e-3, np.arange(0, 11) * 1e-3, indexing="ij")
    at = np.array([10.0, 20.0])
    f = np.interp(at, x, force)
    p = [
        1.07e9
        * np.sqrt(
            np.clip(1 - (gx / 5.84e-3) ** 2 - (gy / 4.6e-3) ** 2, 0, None) * (fi / 60e3) ** (1 / 3)
        )
        for fi in f
    ]
    data["pressure"] = (("instant", "point"), [q.ravel() for q in p], {"units": "Pa"})
    data["point_x"] = ("point", gx.ravel())
    data["point_y"] = ("point", gy.ravel())
    return data.assign_coords(
        instant_position=("instant", at), instant_time=("instant", (at - 6) / SPEED)
    )


def add_sections(data):
    for body, z0, size in (("rail", -0.172, 0.172), ("wheel", 0.0, 0.05)):
        ny, nz = 8, 20
        y, z = np.meshgrid(np.linspace(0, 0.036, ny), np.linspace(z0, z0 + size, nz))
        nodes = np.column_stack([y.ravel(), z.ravel()])
        i = (np.arange(nz - 1)[:, None] * ny + np.arange(ny - 1)).ravel()
        quads = np.column_stack([i, i + 1, i + ny + 1, i + ny])
        moved = np.column_stack([0.002 * nodes[:, 0], -0.8e-3 - 2e-4 * (nodes[:, 1] + 0.172)])
        data[f"section_{body}_nodes"] = ((f"{body}_node", "axis"), nodes)
        data[f"section_{body}_quads"] = ((f"{body}_quad", "corner"), quads)
        data[f"section_{body}_displacement"] = ((f"{body}_node", "axis"), moved)
    return data


def made_study(rough=1.0, name="point_vs_surface", companions=()):
    w = np.geomspace(0.08, 20, 200)
    x = np.arange(0, 36, 0.05)
    rng = np.random.default_rng(3)
    k = np.linspace(0.1, 60, 600)
    noise = rng.gamma(8, 1 / 8, k.size)
    r = np.cos(np.outer(x, w) + rng.uniform(0, 6.28, w.size)) @ np.full(w.size, 1e-4)
    info = IrregularityInfo(
        spectrum=SpectrumCurve("eq. (3), Table 1", w, paper_density(w), (0.08, 20.0)),
        estimate=SpectrumCurve(
            "generated profile, Welch", k, paper_density(k) * noise, (0.3, 20.0)
        ),
        profile=Level("seed 1", x, r),
        measured=SpectrumCurve(
            "measured level", k[:200], 0.3 * paper_density(k[:200]), (0.15, 2.5)
        ),
    )
    runs = {n: made_run(i, rough, n) for i, n in enumerate(CONFIG["runs"])}
    return StudyResults(
        name=name,
        title="Point contact against surface contact",
        description="For tests: 100 % made up, with #special* _characters_ @x $5 <b> {c}.",
        config=copy.deepcopy(CONFIG),
        units=dict(UNITS),
        runs=runs,
        reference="surface",
        metrics=made_metrics(runs, "surface"),
        groups={"irregularity": to_dataset(info if rough else IrregularityInfo())},
        provenance={
            "seed": 1,
            "hash": "0123456789abcdef" * 4,
            "versions": {"contactstudy": "0.1.0", "python": "3.11.2", "numpy": "2.4.6"},
            "mesh": None,
            "sources": [],
        },
        companions=tuple(companions),
    )


def made_metrics(runs, reference):
    cost = {"seconds": {"setup": 1.25, "stepping": 0.375}, "peak_memory_mb": 187.5}
    return study_metrics(runs, dict.fromkeys(runs, cost), reference, 9.0)


@pytest.fixture
def results():
    """A study with all optional data and a smooth companion."""
    return made_study(companions=[made_study(rough=0.0, name="smooth_rail")])


@pytest.fixture(scope="session")
def shared_results():
    """The same, to be read only."""
    return made_study(companions=[made_study(rough=0.0, name="smooth_rail")])


@pytest.fixture
def bare():
    """A study that has point runs only: no patch, no section, no spectra, no companion."""
    study = made_study()
    runs = {n: r for n, r in study.runs.items() if n != "surface"}
    config = {**study.config, "compare": {"reference": "point"}}
    config.pop("solid")
    return StudyResults(
        name="bare",
        title=study.title,
        description="",
        config=config,
        units=study.units,
        runs=runs,
        reference="point",
        metrics=made_metrics(runs, "point"),
        provenance=study.provenance,
    )
