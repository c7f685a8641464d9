"""Vehicles made of vehicles: turned, with elastic wheels, one behind the other."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import block_diag

from contactstudy.validation import not_negative, raise_if
from contactstudy.vehicle.model import Vehicle


def turned(vehicle: Vehicle) -> Vehicle:
    """The vehicle running towards -X: turned by half a turn about Z.

    Its right is the track's left, and its lateral displacements count against the track's.
    """
    if vehicle.planar:
        return vehicle
    across = np.array([direction == "Y" for direction in vehicle.contact_directions])
    return replace(
        vehicle,
        contact_rows=np.where(across[:, None], -1.0, 1.0) * vehicle.contact_rows,
        contact_rails=1 - np.asarray(vehicle.contact_rails),
    )


def with_wheel_modes(
    vehicle: Vehicle, frequencies: np.ndarray, participation: np.ndarray, damping: float
) -> Vehicle:
    """Give the wheel of a vehicle elastic modes, relative to its hub.

    With the mass-normalised modal displacements q after the vehicle's dofs, the kinetic energy
    ``1/2 m_w w'^2 + L . q' w' + 1/2 q'.q'`` couples them with the hub's displacement w by their
    participation L; the wheel's dof keeps its mass, which holds the elastic wheel's.

    Parameters
    ----------
    vehicle : Vehicle
        With one wheel.
    frequencies : ndarray (m,)
        Natural frequencies on a rigid hub [Hz].
    participation : ndarray (m,)
        L [sqrt(kg)].
    damping : float
        Ratio of all modes.

    Raises
    ------
    InputError
        If the wheel's mass is no more than the modes move.
    """
    problems = not_negative("wheel_damping", damping) + vehicle.problems_on_one_rail()
    raise_if(problems)
    wheel, L = int(vehicle.wheel_dofs[0]), np.asarray(participation, dtype=float)
    mass, moved = float(vehicle.mass[wheel, wheel]), float(L @ L)
    if vehicle.n_wheels != 1:
        problems.append(f"wheel modes: the vehicle has {vehicle.n_wheels} wheels; one is possible")
    if not mass > moved:
        problems.append(
            f"wheel_mass = {mass:g} kg: must be above {moved:.4g} kg, what the wheel's elastic "
            "modes move of it"
        )
    raise_if(problems)
    omega = 2.0 * np.pi * np.asarray(frequencies, dtype=float)
    n, m = vehicle.n_dofs, len(omega)
    added = np.eye(m), np.diag(2.0 * damping * omega), np.diag(omega**2)
    matrices = []
    for own, modal in zip((vehicle.mass, vehicle.damping, vehicle.stiffness), added, strict=True):
        whole = np.zeros((n + m, n + m))
        whole[:n, :n], whole[n:, n:] = own, modal
        matrices.append(whole)
    matrices[0][wheel, n:] = matrices[0][n:, wheel] = L
    names = vehicle.dof_names + tuple(f"wheel mode {k + 1}" for k in range(m))
    return replace(
        vehicle,
        mass=matrices[0],
        damping=matrices[1],
        stiffness=matrices[2],
        dof_names=names,
        contact_rows=np.zeros((0, 0)),
    )


def train(vehicles: Sequence[Vehicle], offsets: Sequence[float]) -> Vehicle:
    """Put several vehicles behind each other as one vehicle, uncoupled.

    The offsets are the positions of their leading wheels relative to the first's, at most 0 [m].
    """
    problems = []
    if not vehicles or len(vehicles) != len(offsets):
        problems.append("train: needs at least one vehicle and one offset a vehicle")
    elif max(offsets) != 0.0:
        problems.append("train offsets: 0 for the leading vehicle, negative behind it")
    if len({vehicle.planar for vehicle in vehicles}) > 1:
        problems.append("train: all vehicles must be planar, or none")
    raise_if(problems)
    dofs, first = [], 0
    for vehicle in vehicles:
        dofs.append(np.asarray(vehicle.wheel_dofs, dtype=np.int64) + first)
        first += vehicle.n_dofs
    return Vehicle(
        mass=block_diag(*(vehicle.mass for vehicle in vehicles)),
        damping=block_diag(*(vehicle.damping for vehicle in vehicles)),
        stiffness=block_diag(*(vehicle.stiffness for vehicle in vehicles)),
        wheel_dofs=np.concatenate(dofs),
        wheel_offsets=np.concatenate(
            [v.wheel_offsets + offset for v, offset in zip(vehicles, offsets, strict=True)]
        ),
        static_loads=np.concatenate([vehicle.static_loads for vehicle in vehicles]),
        dof_names=tuple(
            f"{name} {number}"
            for number, vehicle in enumerate(vehicles, start=1)
            for name in vehicle.dof_names
        ),
        contact_rows=block_diag(*(vehicle.contact_rows for vehicle in vehicles)),
        contact_rails=np.concatenate([vehicle.contact_rails for vehicle in vehicles]),
        contact_directions=tuple(d for v in vehicles for d in v.contact_directions),
    )
