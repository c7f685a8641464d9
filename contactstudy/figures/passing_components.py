"""Components of the contact force on a smooth rail that repeat along the track."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from contactstudy.arrays import Array
from contactstudy.compare.passing import passing_amplitude
from contactstudy.compare.signals import position, values
from contactstudy.figures.signals import has_signal
from contactstudy.study.results import StudyResults

ORDERS = 12  # of the support spacing: down to 50 mm for 0.6 m


@dataclass(frozen=True)
class Passing:
    """Components of one run's contact force that repeat with the support spacing.

    Attributes
    ----------
    amplitudes : (ORDERS,) array
        Amplitude in N of the component with wavelength spacing/1, spacing/2, ...
    static : float
        Force in the static equilibrium from which the run starts, N.
    window : (2,) tuple of float
        Positions evaluated, m: a whole number of bays.
    """

    amplitudes: Array
    static: float
    window: tuple[float, float]

    def percent(self, order: int) -> float:
        """Amplitude of the component with wavelength spacing/order in % of the static force."""
        return float(100.0 * self.amplitudes[order - 1] / self.static)


def is_smooth(results: StudyResults) -> bool:
    """Whether every run of the study rolls on a rail without irregularity."""
    return bool(results.runs) and all(
        "irregularity" in run and not np.any(run["irregularity"].values)
        for run in results.runs.values()
    )


def spacing(results: StudyResults) -> float | None:
    """Support spacing of the study's track in m; None on a continuous foundation."""
    found = results.config.get("track", {}).get("spacing")  # absent on a Winkler foundation
    return None if found is None else float(found)


def passing(run: xr.Dataset, bay: float) -> Passing | None:
    """Components of the contact force that repeat with the support spacing `bay` [m].

    Taken over the later half of the run, as many whole bays as it holds: the start from rest
    has died out there.
    None where the run is shorter than four bays.
    """
    x, force = position(run), values(run, "contact_force")
    bays = int((x[-1] - x[0]) / bay / 2 + 1e-9)
    if bays < 2:
        return None
    window = (float(x[-1] - bays * bay), float(x[-1]))
    # One sample more than the window, so that its first end can be interpolated.
    first = max(int(np.searchsorted(x, window[0])) - 1, 0)
    amplitudes = passing_amplitude(x[first:], force[first:], bay, ORDERS, bay)
    return Passing(amplitudes, float(force[0]), window)


def all_passing(results: StudyResults) -> dict[str, Passing]:
    """Components of each run of a smooth study with discrete supports; empty for any other.

    On a bridge the bays differ, and the wheels come from the ground and leave to it.
    """
    bay, on_bridge = spacing(results), results.config.get("track", {}).get("structure") == "bridge"
    if bay is None or on_bridge or not is_smooth(results):
        return {}
    found = {
        name: passing(run, bay)
        for name, run in results.runs.items()
        if has_signal(run, "contact_force")
    }
    return {name: p for name, p in found.items() if p is not None}


def component(results: StudyResults, name: str, p: Passing, kind: str) -> float | None:
    """Amplitude in N of what passes in the run `name`; None where its model has no such thing.

    Parameters
    ----------
    kind : {"sleeper", "element", "cell"}
        Sleeper: at the support spacing. Element and cell: the largest at the length of an
        element or cell and its fractions, as far as they are fractions of the support spacing
        (all of these also contain what the supports themselves cause there).
    """
    if kind == "sleeper":
        return float(p.amplitudes[0])
    first = orders_in_bay(results, name).get(kind)
    if first is None or not 1 <= first <= ORDERS:
        return None
    return float(np.max(p.amplitudes[first - 1 :: first]))


def orders_in_bay(results: StudyResults, name: str) -> dict[str, int]:
    """Number of elements or of cells in a bay of the run `name`, where it is a whole number."""
    run = results.config.get("runs", {}).get(name, {})
    bay = spacing(results)
    cell = results.config.get("solid", {}).get("cell_length")
    if run.get("solver") == "surface" or run.get("rail") == "solid":
        if not (cell and bay):
            return {}
        count = bay / float(cell)
        return {"cell": round(count)} if abs(count - round(count)) < 1e-6 else {}
    return {"element": int(run["elements_per_bay"])} if "elements_per_bay" in run else {}
