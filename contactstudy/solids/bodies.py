"""The bodies that are condensed once and kept."""

from contactstudy.solids.cache import CachedBody, cached
from contactstudy.solids.cell import RailCell, condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, elastic_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, WheelModes, wheel_modes


def rail_body(recipe: CellRecipe) -> CachedBody[RailCell]:
    """The repeated cell of the rail."""
    return CachedBody("rail", recipe, condense, RailCell)


def wheel_body(recipe: WheelRecipe) -> CachedBody[WheelFlexibility]:
    """The elastic wheel, condensed to its tread."""
    return CachedBody("wheel", recipe, elastic_wheel, WheelFlexibility)


def modes_body(recipe: ModesRecipe) -> CachedBody[WheelModes]:
    """The elastic modes of a wheel."""
    return CachedBody("wheel modes", recipe, wheel_modes, WheelModes)


def meshed_wheel(recipe: WheelRecipe | None = None) -> WheelFlexibility:
    """An elastic wheel, the default one without a recipe, condensed or taken from the cache."""
    return cached(wheel_body(recipe or WheelRecipe()))
