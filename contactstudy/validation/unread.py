"""Values that could not be read: rules are asked as far as they do not depend on these.

A table with a wrong value is still read; whatever asks it for that value ends with `UnreadError`.
So one error hides no other, and none is found that only follows from it.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class UnreadError(Exception):
    """A rule depends on a value that could not be read, of which is complained already."""


def asked(rule: Callable[P, Iterable[T]], *args: P.args, **kwargs: P.kwargs) -> list[T]:
    """What a rule finds until it asks for a value that could not be read."""
    found = list[T]()
    try:
        for one in rule(*args, **kwargs):
            found.append(one)
    except UnreadError:
        pass
    return found


def partly(owner: type, values: Mapping[str, Any], unread: Collection[str]) -> Any:
    """Object of a frozen dataclass with `values` of its fields, all but those `unread`."""

    def fail(made: Any, name: str = "") -> Any:
        raise UnreadError(name)

    own = {"__module__": owner.__module__, "_partly": True, "__getattr__": fail}
    made: Any = object.__new__(
        type(owner.__name__, (owner,), own | dict.fromkeys(unread, property(fail)))
    )
    for name, value in values.items():
        if name not in unread:
            object.__setattr__(made, name, value)
    return made


def is_partly(made: Any) -> bool:
    """Whether an object was read in part only."""
    return "_partly" in vars(type(made))
