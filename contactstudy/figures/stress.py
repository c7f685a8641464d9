"""Stress below the contact patch in the planes along and across the rail."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from contactstudy.arrays import Array
from contactstudy.figures.patch import ShownPatch, patches_of
from contactstudy.halfspace.pressure_field import SurfacePressure
from contactstudy.halfspace.subsurface import SHALLOWEST, half_space_stress
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY, VERMILION, new_figure
from contactstudy.plot.text import exact, label, number
from contactstudy.solids.stress import maximum_shear, von_mises
from contactstudy.solvers.patch_fields import instant_pressure
from contactstudy.study.results import StudyResults

_INVARIANTS = {
    "von_mises": ("Von Mises", von_mises),
    "maximum_shear": ("Maximum shear", maximum_shear),
}
# what is drawn, in patch radii: to each side of the centre, and down
_WIDE, _DEEP = 2.2, 2.6
_POINTS = 61


@dataclass(frozen=True)
class Below:
    """What is drawn of one instant.

    Attributes
    ----------
    maxima : dict of str to tuple of float
        Invariant to (value in Pa, x, y, depth in m), as in the dataset.
    """

    load: SurfacePressure
    poisson_ratio: float
    maxima: dict[str, tuple[float, float, float, float]]

    @property
    def radius(self) -> float:
        """Radius in m of the circle with the patch's area."""
        return float(np.sqrt(self.load.area / np.pi))


def drawings(results: StudyResults) -> list[Drawing]:
    """Stresses below the patch of each run that has stored its pressure and their maxima."""
    found = patches_of(results, "maximum_shear")

    def made(name: str, patch: ShownPatch) -> Drawing:
        below = below_of(results.runs[name], patch)
        suffix = f"_{name}" if len(found) > 1 else ""
        return Drawing(f"stress_below{suffix}", _caption(name, patch, below), lambda: _draw(below))

    return [made(name, patch) for name, patch in found.items()]


def below_of(run: xr.Dataset, patch: ShownPatch) -> Below:
    """Pressure and stress maxima of the instant that the patch is of."""
    k = patch.instant
    maxima = {
        name: (
            float(run[name][k]),
            *(float(run[f"{name}_{part}"][k]) for part in ("x", "y", "depth")),
        )
        for name in _INVARIANTS
    }
    nu = float(run["maximum_shear"].attrs["poisson_ratio"])
    return Below(instant_pressure(run, k), nu, maxima)  # type: ignore[arg-type]


def _draw(below: Below) -> Figure:
    figure = new_figure(4.0, equal_axes=True)
    axes = figure.subplots(2, 2, sharex="col", sharey=True)
    _, x0, y0, _ = below.maxima["maximum_shear"]
    for row, (name, (title, invariant)) in zip(axes, _INVARIANTS.items(), strict=True):
        value, x, y, depth = below.maxima[name]
        top = value * 1e-6
        levels = np.asarray(MaxNLocator(10, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, top))
        for ax, along in zip(row, (True, False), strict=True):
            s, z, field = _plane(below, along, (x0, y0), invariant)
            image = _contours(ax, s, z, field, levels)
            _mark(ax, x if along else y, depth, top)
        figure.colorbar(image, ax=list(row), label=f"{title} (MPa)")
    for ax, text in zip(axes[0], (_where("y", y0), _where("x", x0)), strict=True):
        ax.set_title(text)
    axes[0, 0].set(ylabel="Depth (mm)")
    axes[1, 0].set(xlabel="Along the rail x (mm)", ylabel="Depth (mm)")
    axes[1, 1].set(xlabel="Across the rail y (mm)")
    axes[0, 0].invert_yaxis()
    return figure


def _where(axis: str, at: float) -> str:
    return f"Plane {axis} = {exact(round(at * 1e3, 1) + 0.0, 3)} mm"


def _plane(
    below: Below, along: bool, at: tuple[float, float], invariant: Callable[[Array], Array]
) -> tuple[Array, Array, Array]:
    """Invariant in MPa on a grid of a vertical plane through `at`: (n,), (m,) in mm, (m, n)."""
    centre = at[0] if along else at[1]
    s = centre + below.radius * np.linspace(-_WIDE, _WIDE, _POINTS)
    z = below.radius * np.linspace(SHALLOWEST, _DEEP, _POINTS)
    S, Z = np.meshgrid(s, z)
    other = np.full(S.size, at[1] if along else at[0])
    points = [S.ravel(), other] if along else [other, S.ravel()]
    stress = half_space_stress(
        below.load, np.stack([*points, Z.ravel()], axis=1), below.poisson_ratio
    )
    return s * 1e3, z * 1e3, invariant(stress).reshape(S.shape) * 1e-6


def _contours(ax: Axes, s: Array, z: Array, field: Array, levels: Array) -> ScalarMappable:
    image = ax.contourf(s, z, field, levels=levels, cmap="cividis_r")
    ax.contour(s, z, field, levels=levels[1:], colors=BLACK, linewidths=0.25)
    ax.set_aspect("equal")
    ax.grid(False)
    return image


def _mark(ax: Axes, at: float, depth: float, top: float) -> None:
    """Cross at the maximum, with its value and depth."""
    mark = Line2D(
        [at * 1e3], [depth * 1e3], marker="+", ms=7, mew=1.2, color=VERMILION, ls="none",
        label=f"{number(top)} MPa at {number(depth * 1e3)} mm",
    )  # fmt: skip
    ax.add_line(mark)
    ax.legend(
        handles=[mark], loc="lower right", handlelength=1.0, frameon=True, framealpha=1.0,
        edgecolor=GREY, fancybox=False,
    )  # fmt: skip


def _caption(name: str, patch: ShownPatch, below: Below) -> str:
    peak = float(patch.pressure.max())
    mises, shear = below.maxima["von_mises"], below.maxima["maximum_shear"]
    return (
        f"Stress in the rail below the patch of the run {label(name)} at X = "
        f"{exact(patch.position)} m: equivalent stress of von Mises (top) and largest shear "
        "stress (bottom) in the vertical planes through the maximum of the shear (crosses: "
        f"maxima). Von Mises reaches {number(mises[0] * 1e-6)} MPa at a depth of "
        f"{number(mises[3] * 1e3)} mm, the shear {number(shear[0] * 1e-6)} MPa at "
        f"{number(shear[3] * 1e3)} mm, {number(shear[0] / peak, 2)} of the highest nodal pressure. "
        "They are the stresses of an elastic half-space under the computed pressure; those of the "
        "rail's bending and support are not contained."
    )
