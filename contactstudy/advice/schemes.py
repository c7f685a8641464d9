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
_BAY = _PRESS | {"bay_compliance": True}
_MODAL = _BAY | {"wheel": "modal"}

#: Name -> words, and the scheme's table; each adds one thing to the one before.
FAMILIES: Mapping[str, tuple[str, dict[str, Any]]] = {
    "stiff": (
        "Euler beam, large constant k_r (our reading of the paper's scheme)",
        _TANGENT | {"k_r": 1e11},
    ),
    "tangent": ("Euler beam, tangent of the static press", _TANGENT),
    "shear": ("Timoshenko beam with local compliance, tangent of the press", _SHEAR),
    "filtered": ("Timoshenko beam, tangent, roughness averaged over the patch", _FILTERED),
    "press": ("Timoshenko beam, force-approach curve of the press, averaged roughness", _PRESS),
    "bay": ("Timoshenko beam with the meshed rail's give over a bay, press, averaged", _BAY),
    "modal": ("the same beam, press and average, with the wheel's elastic modes", _MODAL),
    "solid": (
        "meshed rail, press, averaged roughness, the wheel's elastic modes",
        {k: v for k, v in _MODAL.items() if not k.endswith("_compliance")} | {"rail": "solid"},
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

    @property
    def words(self) -> str:
        """What its family is called."""
        return FAMILIES[self.family][0]

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
