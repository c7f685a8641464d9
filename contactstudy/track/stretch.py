"""What a solid track shows to the contact: a piece of running surface."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray


@dataclass(frozen=True)
class RailStretch:
    """Running-surface nodes around a position, with their part in the track.

    Node ``ix*len(y) + iy`` lies at ``(x[ix], y[iy])``. Its displacement along the smooth
    surface's outward normal is ``map @ u[dofs] + residual @ f`` for nodal forces ``f`` along
    that normal [N]; a nodal force enters the system as ``map.T @ f`` on `dofs`. With a
    symmetric half model a nodal force is the total of the node and its mirror image.

    Attributes
    ----------
    key : int
        Patches with equal keys have equal `dofs`.
    dofs : ndarray (nd,)
        Dofs of the track.
    map : ndarray (nodes, nd)
    residual : ndarray (nodes, nodes)
        Flexibility that the track's dofs leave out [m/N].
    local : ndarray (nd, nd) or None
        About the static flexibility of `dofs` where a load is near [m/N]: of two cells between
        held outer planes. The map is as finely structured as the residual where the cells meet;
        what is averaged over the mesh is ``residual + map @ local @ map.T``, see
        `contact.residual`.
    x : ndarray (nx,)
        Positions on the track [m].
    y, arc : ndarray (ny,)
        Lateral positions in the rail's axes, and their arc lengths from the crown [m].
    centre_map : ndarray (nm, nc)
        Motion of the rail's centre line at the position asked for: vertical displacement [m];
        for a whole section (nm = 3) also lateral displacement [m] and roll [rad].
    centre_residual : ndarray (nm, nodes)
        What nodal forces add to that motion [m/N, rad/N].
    """

    key: int
    dofs: IntArray
    map: Array
    residual: Array
    local: Array | None
    x: Array
    y: Array
    arc: Array
    centre_dofs: IntArray
    centre_map: Array
    centre_residual: Array

    def crown_node(self, x: float) -> int:
        """The node next to the crown at X [m]."""
        return int(np.abs(self.x - x).argmin() * len(self.y) + np.abs(self.arc).argmin())

    def centre_motion(
        self, u_free: Array, increment: Array, nodal: Array
    ) -> dict[str, Array | float]:
        """Of the centre line under nodal forces (nodes,) on the rail, for the record of a step.

        Returns
        -------
        dict
            `rail_residual` (1,): what the dofs leave out of the deflection [m]; for a whole
            section `rail_lateral` [m] and `rail_roll` [rad], displacements u_free + increment (n,).
        """
        record: dict[str, Array | float] = {
            "rail_residual": np.array([-float(self.centre_residual[0] @ nodal)])
        }
        if len(self.centre_map) == 3:
            at = self.centre_dofs
            motion = self.centre_map[1:] @ (u_free[at] + increment[at])
            motion -= self.centre_residual[1:] @ nodal
            record["rail_lateral"], record["rail_roll"] = float(motion[0]), float(motion[1])
        return record


@dataclass(frozen=True)
class SectionResponse:
    """Displacement of a section plane: ``map @ u[dofs] + residual @ f``, for drawing it.

    Attributes
    ----------
    position : float
        X of the plane [m].
    nodes : ndarray (k, 2)
        y, z [m], z = 0 on top of the rail.
    map : ndarray (k, 2, m)
        Displacement (y, z) of each node.
    residual : ndarray (k, 2, nodes)
        What nodal forces of the `RailStretch` at the same place add [m/N].
    """

    position: float
    nodes: Array
    quads: IntArray
    dofs: IntArray
    map: Array
    residual: Array
