"""The bodies that are condensed once and kept."""

from contactstudy.solids.cache import Body
from contactstudy.solids.cell import RailCell, condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, elastic_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, WheelModes, wheel_modes


def rail_body(recipe: CellRecipe) -> Body[RailCell]:
    """The repeated cell of the rail."""
    return Body("rail", recipe, condense, RailCell)


def wheel_body(recipe: WheelRecipe) -> Body[WheelFlexibility]:
    """The elastic wheel, condensed to its tread."""
    return Body("wheel", recipe, elastic_wheel, WheelFlexibility)


def modes_body(recipe: ModesRecipe) -> Body[WheelModes]:
    """The elastic modes of a wheel."""
    return Body("wheel modes", recipe, wheel_modes, WheelModes)
