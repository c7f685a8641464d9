"""The program's half-space press against Tamaas: same gap field, same load."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.geometry.placement import Geometry
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.halfspace.love import LoveGrid, contact_pressure
from contactstudy.halfspace.patch_grid import Bodies
from contactstudy.halfspace.patches import press_wheel
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.manchester import LOAD, MODULUS, RADIUS, benchmark_pose
from contactstudy.verification.check import CaseResult, Check

BAND = 1e-3
"""Both solve the same discrete problem; what differs is the iterations' end."""
METHOD = (
    "The same gap field on the same cells and the same load go to the program's projected "
    "conjugate gradients on Love's influence of uniformly loaded rectangles, and to Tamaas "
    "{version} (L. Frérot, G. Anciaux, V. Rey, S. Pham-Ba, J.-F. Molinari, J. Open Source Software "
    "5 (2020) 2121): its Polonsky-Keer-Rey solver with the non-periodic operator 'dcfft'. The "
    "fields are Hertz's, for a wheel of 0.43 m on a crown of 0.30 m under 60 kN, and the "
    "undeformed gaps of two positions of the Manchester benchmark A-2.2, far from ellipses."
)


@dataclass(frozen=True)
class _Field:
    name: str
    grid: LoveGrid
    gap: Array  # at the approach that gives the load (nx, ny) [m]


def tamaas_codes() -> CaseResult:
    """Peak pressure, approach, area and the whole field, against Tamaas on the same cells."""
    import tamaas

    source = f"Tamaas {tamaas.__version__}"
    checks: list[Check] = []
    for field in (_hertz(), _benchmark(1), _benchmark(11)):
        p = contact_pressure(field.grid, field.gap)
        load = float(p.sum()) * field.grid.cell_area
        other, approach = _tamaas(field, load)
        peak, cell = float(other.max()), field.grid.cell_area * 1e6
        pairs = (
            ("peak pressure", p.max() * 1e-6, peak * 1e-6, "MPa", BAND, None),
            ("approach", -field.gap.min() * 1e6, approach * 1e6, "µm", BAND, None),
            ("area", np.count_nonzero(p) * cell, np.count_nonzero(other) * cell, "mm²", BAND, None),
            ("largest difference of pressure", np.abs(p - other).max() * 1e-6, 0.0, "MPa", BAND,
             peak * 1e-6),
        )  # fmt: skip
        checks += [
            Check(f"{field.name}: {name}", float(a), float(b), unit, source, band, scale=scale)
            for name, a, b, unit, band, scale in pairs
        ]
    return CaseResult(
        "tamaas_codes",
        "Half-space press against Tamaas",
        METHOD.format(version=tamaas.__version__),
        tuple(checks),
    )


def _hertz(cells: int = 64) -> _Field:
    modulus = contact_modulus(210e9, 0.3)
    h = hertz_contact(60e3, modulus, 0.43, 0.30)
    width, breadth = (2.3 * a / cells for a in (h.semi_axis_x, h.semi_axis_y))
    i = np.arange(cells) - 0.5 * (cells - 1)
    gap = (i * width)[:, None] ** 2 / 0.86 + (i * breadth) ** 2 / 0.60 - h.approach
    return _Field("Hertz", LoveGrid((cells, cells), width, breadth, modulus), gap)


def _benchmark(case: int) -> _Field:
    """Gap of the left wheel at the travel that its press found."""
    pose = benchmark_pose(case, "left")
    geometry = Geometry(rail_curve("UIC60-Manchester"), wheel_curve("S1002"), RADIUS, pose)
    press = press_wheel(geometry, LOAD, MODULUS, cells=16)
    bodies = Bodies(geometry, MODULUS)
    (grid,) = bodies.regions(press.travel, 4e-3, 64)
    gap = bodies.facing(press.travel, grid).gap.reshape(grid.love.shape)
    return _Field(f"A-2.2, position {case}, left wheel", grid.love, gap)


def _tamaas(field: _Field, load: float) -> tuple[Array, float]:
    """Pressure [Pa] and approach [m] of the deepest point by Tamaas, in mm and MPa inside."""
    import tamaas

    grid = field.grid
    size = grid.shape[0] * grid.width, grid.shape[1] * grid.breadth
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [1e3 * v for v in size], list(grid.shape)
    )
    # E/(1 - nu^2) is E*; the rigid surface carries the gap upside down
    model.E, model.nu = grid.modulus * 1e-6, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tamaas.PolonskyKeerRey(model, -field.gap * 1e3, 1e-12)
    solver.setIntegralOperator("dcfft")
    solver.max_iter = 5000
    # it prints its iterations every so often
    solver.dump_freq = 10**6
    solver.solve(load / (size[0] * size[1]) * 1e-6)
    traction = np.asarray(model.traction).reshape(grid.shape)
    # in contact gap + K p is the approach beyond that of the given field
    moved = np.zeros_like(np.asarray(model.traction))
    model.operators["dcfft"](model.traction, moved)
    level = (field.gap + moved.reshape(grid.shape) * 1e-3)[traction > 0].mean()
    return traction * 1e6, float(level - field.gap.min())
