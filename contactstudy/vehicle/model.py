"""Vehicles as matrices: M, C, K, contacts with the rails and static wheel loads.

Displacements are measured from the static equilibrium of the suspensions, so that gravity
appears only as the constant force -static_load in each vertical contact.
"""

from dataclasses import dataclass, field

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.validation import raise_if


def _none() -> IntArray:
    return np.zeros(0, dtype=np.int64)


def _no_rows() -> Array:
    return np.zeros((0, 0))


def _lowest_eigenvalue(matrix: Array) -> float:
    """Of a symmetric matrix (n, n), from each part that is coupled: a train is one of many."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    count, part = connected_components(csr_array(matrix), directed=False)
    order = np.argsort(part, kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(part, minlength=count))[:-1])
    return min(
        float(np.linalg.eigvalsh(matrix[np.ix_(p, p)])[0]) if len(p) > 1 else matrix[p[0], p[0]]
        for p in parts
    )


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
            elif nv and _lowest_eigenvalue(matrix) < -1e-9 * np.abs(matrix).max():
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
