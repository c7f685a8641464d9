"""A patch must lie within the finely meshed zone of the wheel."""

from contactstudy.arrays import BoolArray
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.points import ContactPoints


def check_edge(points: ContactPoints, active: BoolArray, where: str) -> None:
    """Raise if an outermost line of points is in contact.

    Raises
    ------
    NumericalError
        Naming the key of the zone that is too small.
    """
    grid = active.reshape(len(points.x), -1)
    across = grid[:, -1].any() or (not points.symmetric and grid[:, 0].any())
    if not (across or grid[0].any() or grid[-1].any()):
        return
    lines, way = (points.wheel_y, "across") if across else (points.wheel_x, "along")
    key = "contact_half_width" if across else "contact_half_length"
    raise NumericalError(
        f"contact patch reaches the edge of the finely meshed zone {way} the rail at {where}: the "
        f"wheel's zone, {1e3 * lines[0]:.4g} to {1e3 * lines[-1]:.4g} mm, is too small ({key})"
    )
