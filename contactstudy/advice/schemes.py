"""The point schemes that are tried, as tables ``[runs.NAME]`` of a study file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

REFERENCE = "surface"
_TANGENT = {"solver": "point", "rail": "euler", "k_r": "tangent"}
_SHEAR = _TANGENT | {"rail": "timoshenko", "local_compliance": True}
_FILTERED = _SHEAR | {"contact_filter": "patch"}
_PRESS = {key: value for key, value in _FILTERED.items() if key != "k_r"} | {"law": "press"}
_MODAL = _PRESS | {"wheel": "modal"}

#: Name -> what the scheme leaves out of surface contact, and its table; each adds one thing.
FAMILIES: Mapping[str, tuple[str, dict[str, Any]]] = {
    "stiff": (
        "a large constant k_r on an Euler beam, our reading of the paper's scheme",
        _TANGENT | {"k_r": 1e11},
    ),
    "tangent": ("the tangent of the static press on an Euler beam", _TANGENT),
    "shear": ("the same on a Timoshenko beam with the loaded element's own compliance", _SHEAR),
    "filtered": ("the same, the roughness averaged over the patch", _FILTERED),
    "press": ("the same with the force-approach curve of the press", _PRESS),
    "modal": ("the same with the wheel's elastic modes", _MODAL),
    "solid": (
        "the same on the meshed rail",
        {k: v for k, v in _MODAL.items() if k != "local_compliance"} | {"rail": "solid"},
    ),
}
ELEMENTS = (2, 4, 8)
"""Elements a bay that are tried."""
STEPS = (4, 2, 1)
"""Time steps that are tried, in steps of the journey."""


@dataclass(frozen=True)
class Scheme:
    """A point scheme: its family, and its table in a study file."""

    family: str
    table: Mapping[str, Any]

    def toml(self, name: str = "point") -> str:
        """The table as it stands in a study file."""
        lines = [f"{key} = {_toml(value)}" for key, value in self.table.items()]
        return "\n".join([f"[runs.{name}]", *lines])


def schemes(time_step: float) -> dict[str, Scheme]:
    """Name -> all schemes, for a study of a time step [s]."""
    found = {}
    for family, (_, table) in FAMILIES.items():
        for multiple in STEPS:
            # the journey's own step is no key of the run: it is what the study says
            step = {} if multiple == 1 else {"time_step": f"{1e6 * multiple * time_step:.6g} us"}
            for elements in ELEMENTS if table["rail"] != "solid" else (0,):
                mesh = {"elements_per_bay": elements} if elements else {}
                name = f"{family}_{elements}_{multiple}" if elements else f"{family}_{multiple}"
                found[name] = Scheme(family, table | mesh | step)
    return found


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"
