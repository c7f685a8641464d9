"""Point contact: a law between the wheel and the rail at the wheel's position.

The paper's eqs (4)-(6) put k_r between the wheel and the interpolated rail, with shape
functions N at the wheel: the gap row is B = (+1 on the wheel, -N on the rail), and

    g = B u + c lambda - r(X),

c being the compliance of the loaded element itself, which N leaves out (0 in the paper). A
positive r raises the running surface. Literal eq. (6), f_r = (N, -1) k_r r, pushes the rail up
and the wheel down for positive r, so its positive r is a dip: r here is minus the paper's.
"""

import numpy as np

from contactstudy.contact.laws import ContactLaw, contact_forces
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.rows import dense_rows, row_products, row_values
from contactstudy.dynamics.stepper import ContactStep


class PointCoupling:
    """One point under every wheel, with all positions known in advance.

    Parameters
    ----------
    law : ContactLaw
    wheel_dofs : ndarray
        (nw,) dofs of the system.
    rail_dofs, rail_weights : ndarray
        (n_times, nw, k) row of the rail's displacement under each wheel at each state.
    local_compliance : ndarray
        (n_times, nw) c [m/N]. Two wheels within one element do not share it: each feels its own.
    irregularity : ndarray
        (n_times, nw) r [m].
    static_loads : ndarray
        (nw,) [N].
    bilateral : bool
        Whether the contact holds in tension (lateral direction).

    Attributes
    ----------
    local_compliance : ndarray
        As given.
    """

    def __init__(
        self,
        law: ContactLaw,
        wheel_dofs: np.ndarray,
        rail_dofs: np.ndarray,
        rail_weights: np.ndarray,
        local_compliance: np.ndarray,
        irregularity: np.ndarray,
        static_loads: np.ndarray,
        bilateral: bool = False,
    ) -> None:
        self._law, self._loads, self._bilateral = law, static_loads, bilateral
        n_times, n_wheels, _ = rail_dofs.shape
        wheel = np.broadcast_to(wheel_dofs[None, :, None], (n_times, n_wheels, 1))
        self._dofs = np.concatenate((wheel, rail_dofs), axis=2)
        self._weights = np.concatenate((np.ones((n_times, n_wheels, 1)), -rail_weights), axis=2)
        self.local_compliance, self._irregularity = local_compliance, irregularity

    def attach(self, factor: Factor, scale: float) -> None:
        """Take the factor of the system and the share of the new force in a step."""
        self._factor, self._scale = factor, scale

    def __call__(self, step: int, u_free: np.ndarray) -> ContactStep:
        """Forces at the end of a step; every row adds up, two wheels in one element too."""
        dofs, weights = self._dofs[step], self._weights[step]
        rows = dense_rows(dofs, weights, self._factor.n)  # B
        moved = np.empty_like(rows)  # (1-af) B S^-1
        for i, row in enumerate(rows):
            np.multiply(self._scale, self._factor.solve(row), out=moved[i])
        # W_ij = (1-af) B_i S^-1 B_j^T, and the loaded element's own share on the diagonal
        compliance = row_products(dofs, weights, moved)
        compliance.flat[:: len(dofs) + 1] += self.local_compliance[step]
        free_gap = row_values(dofs, weights, u_free) - self._irregularity[step]
        force = contact_forces(self._law, compliance, free_gap, self._loads, self._bilateral)
        return ContactStep(force @ rows, force @ moved, {"contact_force": force})
