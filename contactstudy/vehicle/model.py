"""Vehicles as matrices: M, C, K, contacts with the rails and static wheel loads.

Displacements are measured from the static equilibrium of the suspensions, so that gravity
appears only as the constant force -static_load in each vertical contact.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg import block_diag

from contactstudy.arrays import Array, IntArray
from contactstudy.validation import not_negative, raise_if


def _none() -> IntArray:
    return np.zeros(0, dtype=np.int64)


def _no_rows() -> Array:
    return np.zeros((0, 0))


@dataclass(frozen=True)
class Vehicle:
    """A linear vehicle on one rail or on two.

    A contact is a wheel in one direction. In a planar vehicle each contact is a dof of its own, on
    the one rail, upwards: `wheel_dofs` says it all. Otherwise `contact_rows` are given, and no
    `wheel_dofs`.

    Parameters
    ----------
    mass, damping, stiffness
        (nv, nv), symmetric.
    wheel_dofs
        (nc,) the dofs that are wheel displacements; (0,) where rows are given.
    wheel_offsets
        (nc,) position of each contact relative to the leading wheel, at most 0 [m].
    static_loads
        (nc,) static force of each contact on the rail, positive in compression [N]; 0 for "Y".
    contact_rows
        (nc, nv) displacement of the tread in the contact's direction, of the dofs.
    contact_rails
        (nc,) 0 for a single rail; of two, seen along +X, 0 is the right one and 1 the left (+Y).
    contact_directions
        (nc,) "Z" or "Y".

    Raises
    ------
    InputError
        If shapes do not fit together or values are impossible.
    """

    mass: Array
    damping: Array
    stiffness: Array
    wheel_dofs: IntArray
    wheel_offsets: Array
    static_loads: Array
    dof_names: tuple[str, ...]
    contact_rows: Array = field(default_factory=_no_rows)
    contact_rails: IntArray = field(default_factory=_none)
    contact_directions: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        raise_if(self._wrong_matrices() + self._wrong_contacts())
        nc = self.n_contacts
        if not self.contact_rows.size and len(self.wheel_dofs):
            object.__setattr__(self, "contact_rows", np.eye(self.n_dofs)[self.wheel_dofs])
        if not len(self.contact_rails):
            object.__setattr__(self, "contact_rails", np.zeros(nc, dtype=np.int64))
        if not self.contact_directions:
            object.__setattr__(self, "contact_directions", ("Z",) * nc)

    def _wrong_matrices(self) -> list[str]:
        nv, problems = self.n_dofs, []
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
        return problems

    def _wrong_contacts(self) -> list[str]:
        nv, nc, problems = self.n_dofs, self.n_contacts, []
        rows, dofs = self.contact_rows, self.wheel_dofs
        if nc == 0 or len(self.wheel_offsets) != nc or len(dofs) not in (0, nc):
            problems.append(
                "vehicle: wheel_dofs, wheel_offsets and static_loads must have one value a wheel"
            )
        elif np.any(self.wheel_offsets > 0.0) or np.max(self.wheel_offsets) != 0.0:
            problems.append("vehicle wheel_offsets: 0 for the leading wheel, negative behind it")
        elif len(dofs) and not np.all((np.asarray(dofs) >= 0) & (np.asarray(dofs) < nv)):
            problems.append(f"vehicle wheel_dofs: must be dofs of the vehicle, 0 to {nv - 1}")
        if (rows.size or not len(dofs)) and rows.shape != (nc, nv):
            problems.append(f"vehicle contact_rows: shape {rows.shape}, must be ({nc}, {nv})")
        elif not np.all(np.isfinite(rows)):
            problems.append("vehicle contact_rows: must be finite")
        if len(self.contact_rails) not in (0, nc) or not np.isin(self.contact_rails, (0, 1)).all():
            problems.append("vehicle contact_rails: 0 or 1, one value a contact")
        directions = self.contact_directions
        if len(directions) not in (0, nc) or not set(directions) <= {"Z", "Y"}:
            problems.append('vehicle contact_directions: "Z" or "Y", one value a contact')
        if np.any(~np.isfinite(self.static_loads)) or np.any(self.static_loads < 0.0):
            problems.append("vehicle static_loads: must be finite and at least 0 N")
        return problems

    @property
    def n_dofs(self) -> int:
        """Number of dofs."""
        return len(self.dof_names)

    @property
    def n_contacts(self) -> int:
        """Number of contacts."""
        return len(self.static_loads)

    @property
    def n_wheels(self) -> int:
        """Number of wheels."""
        return sum(direction == "Z" for direction in self.contact_directions)

    @property
    def contact_offsets(self) -> Array:
        """(nc,) position of each contact relative to the leading wheel, at most 0 [m]."""
        return self.wheel_offsets

    @property
    def planar(self) -> bool:
        """Whether every contact is a dof of its own, upwards on the one rail."""
        return len(self.wheel_dofs) > 0

    def problems_on_one_rail(self) -> list[str]:
        """Complaint of a solver with one rail about a vehicle that is not planar."""
        if self.planar:
            return []
        rails, directions = set(self.contact_rails.tolist()), set(self.contact_directions)
        return [
            f"vehicle: has {len(rails)} rail(s) and contacts in {' and '.join(sorted(directions))};"
            " this track has one rail, which carries a planar vehicle only (heave and pitch)"
        ]


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
        contact_rows=_no_rows(),
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
