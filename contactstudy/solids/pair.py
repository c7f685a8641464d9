"""Two neighbouring condensed cells by plane, the stretch in which a contact patch lies."""

from dataclasses import dataclass

from contactstudy.arrays import Array
from contactstudy.solids.cell import RailCell, pair_rows


@dataclass(frozen=True)
class CellPair:
    """Rows and residuals of the 2*ns + 1 planes of two cells.

    Coordinates are those of both cells, the interface between them once.

    Attributes
    ----------
    surface : ndarray (2*ns + 1, ny, width)
        Normal displacement of the running-surface nodes.
    residual : ndarray (2*ns + 1, ny, 2*ns + 1, ny)
        Residual flexibility between surface nodes in m/N.
    centre : ndarray (2*ns + 1, nm, width)
        Mean motions of the section.
    centre_residual : ndarray (2*ns + 1, nm, 2*ns + 1, ny)
        What surface loads add to them in m/N (roll: rad/N).
    section_residual : ndarray (k, 2, 2*ns + 1, ny)
        What surface loads add to the displacement (y, z) of the nodes of the middle plane.
    """

    surface: Array
    residual: Array
    centre: Array
    centre_residual: Array
    section_residual: Array


def cell_pair(cell: RailCell) -> CellPair:
    """Put two equal cells side by side."""
    ns, m = cell.recipe.n_slices, cell.recipe.interface_modes
    ny = len(cell.surface_y)
    planes = 2 * ns + 1
    return CellPair(
        surface=pair_rows(cell.surface_map, m),
        residual=cell.residual.reshape(planes, ny, planes, ny),
        centre=pair_rows(cell.centre_map, m),
        centre_residual=cell.centre_residual.reshape(planes, -1, planes, ny),
        section_residual=cell.section_residual.reshape(-1, 2, planes, ny),
    )
