"""Vehicles as matrices: M, C, K, wheel dofs and static wheel loads.

Displacements are measured from the static equilibrium of the suspensions, so that gravity
appears only as the constant force -static_load on each wheel dof.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from contactstudy.validation import not_negative, raise_if


@dataclass(frozen=True)
class Vehicle:
    """A linear vehicle on one rail.

    Parameters
    ----------
    mass, damping, stiffness
        (nv, nv), symmetric.
    wheel_dofs
        (nw,) the dofs that are wheel displacements.
    wheel_offsets
        (nw,) position of each wheel relative to the leading wheel, at most 0 [m].
    static_loads
        (nw,) static force of each wheel on the rail, positive in compression [N].

    Raises
    ------
    InputError
        If shapes do not fit together or values are impossible.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    wheel_dofs: np.ndarray
    wheel_offsets: np.ndarray
    static_loads: np.ndarray
    dof_names: tuple[str, ...]

    def __post_init__(self) -> None:
        nv, nw = len(self.dof_names), len(self.wheel_dofs)
        problems = []
        for name in ("mass", "damping", "stiffness"):
            matrix = getattr(self, name)
            if matrix.shape != (nv, nv):
                problems.append(f"vehicle {name}: shape {matrix.shape}, must be ({nv}, {nv})")
            elif not np.all(np.isfinite(matrix)):
                problems.append(f"vehicle {name}: must be finite")
            elif not np.allclose(matrix, matrix.T, rtol=1e-12, atol=0.0):
                problems.append(f"vehicle {name}: must be symmetric")
            elif nv and np.linalg.eigvalsh(matrix)[0] < -1e-9 * np.abs(matrix).max():
                problems.append(f"vehicle {name}: must be positive semi-definite")
        if nw == 0 or len(self.wheel_offsets) != nw or len(self.static_loads) != nw:
            problems.append(
                "vehicle: wheel_dofs, wheel_offsets and static_loads must have one value a wheel"
            )
        elif np.any(self.wheel_offsets > 0.0) or np.max(self.wheel_offsets) != 0.0:
            problems.append("vehicle wheel_offsets: 0 for the leading wheel, negative behind it")
        if np.any(~np.isfinite(self.static_loads)) or np.any(self.static_loads < 0.0):
            problems.append("vehicle static_loads: must be finite and at least 0 N")
        raise_if(problems)

    @property
    def n_dofs(self) -> int:
        """Number of dofs."""
        return len(self.dof_names)

    @property
    def n_wheels(self) -> int:
        """Number of wheels."""
        return len(self.wheel_dofs)


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
    wheel, L = int(vehicle.wheel_dofs[0]), np.asarray(participation, dtype=float)
    mass, moved = float(vehicle.mass[wheel, wheel]), float(L @ L)
    problems = not_negative("wheel_damping", damping)
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
    fields = dict(zip(("mass", "damping", "stiffness"), matrices, strict=True))
    return replace(vehicle, dof_names=names, **fields)


def train(vehicles: Sequence[Vehicle], offsets: Sequence[float]) -> Vehicle:
    """Put several vehicles behind each other as one vehicle, uncoupled.

    The offsets are the positions of their leading wheels relative to the first's, at most 0 [m].
    """
    problems = []
    if not vehicles or len(vehicles) != len(offsets):
        problems.append("train: needs at least one vehicle and one offset a vehicle")
    elif max(offsets) != 0.0:
        problems.append("train offsets: 0 for the leading vehicle, negative behind it")
    raise_if(problems)
    n = sum(vehicle.n_dofs for vehicle in vehicles)
    mass, damping, stiffness = (np.zeros((n, n)) for _ in range(3))
    first, dofs, names = 0, [], []
    for number, vehicle in enumerate(vehicles, start=1):
        block = slice(first, first + vehicle.n_dofs)
        mass[block, block] = vehicle.mass
        damping[block, block] = vehicle.damping
        stiffness[block, block] = vehicle.stiffness
        dofs.append(vehicle.wheel_dofs + first)
        names += [f"{name} {number}" for name in vehicle.dof_names]
        first += vehicle.n_dofs
    return Vehicle(
        mass=mass,
        damping=damping,
        stiffness=stiffness,
        wheel_dofs=np.concatenate(dofs),
        wheel_offsets=np.concatenate(
            [v.wheel_offsets + offset for v, offset in zip(vehicles, offsets, strict=True)]
        ),
        static_loads=np.concatenate([vehicle.static_loads for vehicle in vehicles]),
        dof_names=tuple(names),
    )
