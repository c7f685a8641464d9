"""Results of CalculiX for an exported press, read from its .dat file."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import NumericalError

_HEADINGS = ("displacements", "contact stress", "contact print energy", "statistics")


@dataclass(frozen=True)
class CalculixPress:
    """Static press as CalculiX found it; forces and areas of a half model are of both halves.

    Attributes
    ----------
    approach : float
        Displacement of the hub towards the rail's clamped ends in m.
    force : float
        Vertical contact force in N.
    lateral_force : float
        Force on the wheel along Y in N; 0 of the two halves together.
    area : float
        Area of the integration points in contact in m^2.
    element : ndarray of int (k,)
        Element of the tread of each integration point in contact, counted from 0.
    pressure : ndarray (k,)
        At these points in Pa.
    point_area : ndarray (k,)
        Area that each of them stands for in m^2.
    """

    approach: float
    force: float
    lateral_force: float
    area: float
    element: IntArray
    pressure: Array
    point_area: Array

    def face_pressure(self, elements: IntArray, areas: Array) -> Array:
        """Mean pressure over each of the tread's faces in Pa, open parts counted as zero.

        Parameters
        ----------
        elements : ndarray of int (f,)
            Elements of the faces.
        areas : ndarray (f,)
            Areas of the faces in m^2, of both halves of a half model.
        """
        force = np.zeros(int(max(elements.max(), self.element.max())) + 1)
        np.add.at(force, self.element, self.pressure * self.point_area)
        return np.asarray(force[elements] / areas)


def read_presses(path: Path, penalty: float, symmetric: bool = True) -> tuple[CalculixPress, ...]:
    """Read the load steps of a .dat file.

    Parameters
    ----------
    penalty : float
        Of the model in Pa/m: gives the areas from the contact energies.
    symmetric : bool
        It is a half model: what it says counts twice.

    Raises
    ------
    NumericalError
        If a result is lacking, because the solution was not finished.
    """
    try:
        # the hub's displacements come first in each load step
        steps = re.split(r"\n(?= *displacements)", path.read_text("ascii", errors="replace"))
        blocks = [_blocks(step) for step in steps[1:] or steps]
        return tuple(_press(found, penalty, symmetric) for found in blocks)
    except (OSError, KeyError, IndexError) as error:
        raise NumericalError(
            f"CalculiX: {path.name} does not hold the results of a finished press "
            f"(missing: {error})"
        ) from error


def _press(blocks: dict[str, list[list[float]]], penalty: float, symmetric: bool) -> CalculixPress:
    hub = blocks["displacements"][0]
    stress = np.array(blocks["contact stress"])
    energy = np.array(blocks["contact print energy"])
    # rows of the statistics: force and moment; centre and normal; moment; area, forces
    statistics = blocks["statistics"]
    lateral, force, area = *statistics[0][1:3], statistics[-1][0]
    pressure, halves = 1e6 * stress[:, 2], 2.0 if symmetric else 1.0
    # energy of a point: 1/2 p A (p/penalty); N mm to J
    point_area = 2.0 * 1e-3 * energy[:, 2] * penalty / pressure**2
    return CalculixPress(
        approach=-1e-3 * hub[3],
        force=halves * force,
        lateral_force=0.0 if symmetric else lateral,
        area=halves * 1e-6 * area,
        element=stress[:, 0].astype(np.int64) - 1,
        pressure=pressure,
        point_area=halves * point_area,
    )


def _blocks(text: str) -> dict[str, list[list[float]]]:
    """Rows of numbers under each heading."""
    blocks: dict[str, list[list[float]]] = {}
    current: list[list[float]] = []
    for line in text.splitlines():
        words = line.split()
        try:
            row = [float(word) for word in words]
        except ValueError:
            heading = next((h for h in _HEADINGS if line.strip().startswith(h)), None)
            if heading is not None:
                current = blocks[heading] = []
        else:
            if row:
                current.append(row)
    return blocks
