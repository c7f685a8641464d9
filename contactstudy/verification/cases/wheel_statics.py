"""Cases of the elastic wheel's static flexibility: whole against half section, mesh, modes."""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.wheel import WheelFlexibility, elastic_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, residual_flexibility, wheel_modes
from contactstudy.solids.wheel_recipe import FAR_STEP_OF_MODES, WheelRecipe
from contactstudy.verification.check import CaseResult, Check, ResultTable

EVEN = WheelDimensions(rim_inside=-0.0675, rim_outside=0.0675)
"""Default wheel with its tape circle in the middle of the rim, as the half section has it."""

SOURCE = "half section, another mesh"
SIZES = (0.004, 0.002, 0.001)


def statics() -> CaseResult:
    """Hub to tread: two different meshes of one wheel, three mesh sizes, modes and their rest."""
    half = elastic_wheel(WheelRecipe(dimensions=EVEN, size=0.002))
    whole = elastic_wheel(WheelRecipe(dimensions=EVEN, size=0.002, symmetric=False))
    paired, middle = folded(whole), len(half.x) // 2 * len(half.y)
    stiff = [hub_stiffness(elastic_wheel(WheelRecipe(size=size))) for size in SIZES]
    fine = hub_stiffness(elastic_wheel(WheelRecipe(size=SIZES[1], far_step=FAR_STEP_OF_MODES)))
    recipe = WheelRecipe(far_step=FAR_STEP_OF_MODES)
    wheel = elastic_wheel(recipe)
    rows = []
    for highest in (2000.0, 5000.0, 10000.0):
        modes = wheel_modes(ModesRecipe(recipe, highest))
        rest = residual_flexibility(wheel, modes)
        low = float(np.linalg.eigvalsh(rest.flexibility)[0] / wheel.flexibility.max())
        share = 1 - hub_stiffness(wheel) / hub_stiffness(rest)
        rows.append((highest / 1000, len(modes.frequencies), 100 * share, low))
    F = half.flexibility
    apart = "planes 12 degrees apart"
    checks = (
        *(
            Check(f"{what}, whole section", float(own), float(other), "m/N", SOURCE, 0.005)
            for what, own, other in (
                ("mean flexibility over the zone", paired.mean(), F.mean()),
                ("flexibility of the middle node", paired[middle, middle], F[middle, middle]),
            )
        ),
        Check("hub to tread, 2 mm", stiff[1], stiff[2], "N/m", "the same at 1 mm", 0.01),
        Check(f"hub to tread, {apart}", stiff[1], fine, "N/m", "the same, 3 degrees", 0.005),
        Check(
            "least eigenvalue of a residual flexibility over its largest entry",
            min(row[3] for row in rows),
            0.0,
            "",
            "positive semi-definite",
            1e-12,
            sense="at_least",
            scale=1.0,
        ),
    )
    return CaseResult(
        name="wheel_statics",
        title="Static flexibility of the wheel between hub and tread",
        method=(
            "A load spread evenly over 24 x 16 mm of tread and the mean displacement there "
            "relative to the hub. The same wheel with a cylindrical tread is meshed as a half "
            "section, and as a whole one by another mapping; loads on the whole are mirrored "
            "pairs. The force on the half acts along the rail's normal, on the whole along the "
            "wheel's own.\n\n"
            "What modes up to a frequency take over of the flexibility under that load grows "
            "with the frequency; what they leave must stay positive semi-definite."
        ),
        checks=checks,
        tables=(
            ResultTable(
                "Stiffness between hub and tread under the spread load",
                ("element size (mm)", "stiffness (GN/m)", "above that at 1 mm (%)"),
                tuple(
                    (1000 * size, k / 1e9, 100 * (k / stiff[-1] - 1))
                    for size, k in zip(SIZES, stiff, strict=True)
                ),
            ),
            ResultTable(
                "Share of the modes in the flexibility under the spread load, half section",
                ("up to (kHz)", "modes", "share (%)", "least eigenvalue of the rest (relative)"),
                tuple(rows),
            ),
        ),
    )


def folded(wheel: WheelFlexibility) -> Array:
    """Flexibility of a whole wheel for mirrored pairs of loads, as a half section has it."""
    nx, ny = len(wheel.x), len(wheel.y)
    middle = ny // 2
    F = wheel.flexibility.reshape(nx, ny, nx, ny)
    right, left = F[..., middle:], F[..., middle::-1]
    return np.asarray(0.5 * (right + left)[:, middle:].reshape(nx * (middle + 1), -1))


def hub_stiffness(wheel: WheelFlexibility) -> float:
    """Load spread evenly over the contact zone over its mean displacement [N/m]."""
    weights = np.outer(_trapezium(wheel.x), _trapezium(wheel.y)).ravel()
    return float(1.0 / (weights @ wheel.flexibility @ weights))


def _trapezium(lines: Array) -> Array:
    steps = np.diff(lines)
    weights = 0.5 * (np.r_[steps, 0.0] + np.r_[0.0, steps])
    return np.asarray(weights / weights.sum())
