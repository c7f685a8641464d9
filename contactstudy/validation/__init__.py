"""What a parameter is, and how impossible arguments are refused: all of them in one error.

A frozen dataclass that derives from `Parameters` states each of its parameters once:
``pad_stiffness: Annotated[float, Unit("N/m"), Above(0), "rail pad stiffness"] = 65e6``. From that
come the limits for a caller from Python and for a table of a study file (`read`), the values and
units that are printed (`resolved`, `units`), and the list of all keys (`entries`).
"""

from contactstudy.validation.base import Naming, Parameters
from contactstudy.validation.checks import not_negative, positive, raise_if
from contactstudy.validation.definition import Parameter, as_list, listed, parameter, parameters
from contactstudy.validation.messages import any_of, complaint, did_you_mean, unknown
from contactstudy.validation.metadata import (
    Above,
    AtLeast,
    AtMost,
    By,
    File,
    Key,
    Lines,
    Multiples,
    Same,
    Unit,
    Usual,
    Variants,
    When,
    Written,
    by,
    is_multiple,
    multiple,
)
from contactstudy.validation.tables import (
    Entry,
    Table,
    entries,
    read,
    resolve_paths,
    resolved,
    units,
    wrong_for_all,
)
from contactstudy.validation.unread import UnreadError, asked

__all__ = [
    "Above",
    "AtLeast",
    "AtMost",
    "By",
    "Entry",
    "File",
    "Key",
    "Lines",
    "Multiples",
    "Naming",
    "Parameter",
    "Parameters",
    "Same",
    "Table",
    "Unit",
    "UnreadError",
    "Usual",
    "Variants",
    "When",
    "Written",
    "any_of",
    "as_list",
    "asked",
    "by",
    "complaint",
    "did_you_mean",
    "entries",
    "is_multiple",
    "listed",
    "multiple",
    "not_negative",
    "parameter",
    "parameters",
    "positive",
    "raise_if",
    "read",
    "resolve_paths",
    "resolved",
    "units",
    "unknown",
    "wrong_for_all",
]
