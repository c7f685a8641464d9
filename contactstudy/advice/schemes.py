"""The point schemes that are tried, as tables ``[runs.NAME]`` of a study file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

_TANGENT = {"solver": "point", "rail": "euler", "k_r": "tangent"}
_SHEAR = _TANGENT | {"rail": "timoshenko", "local_compliance": True}
_FILTERED = _SHEAR | {"contact_filter": "patch"}
_PRESS = {key: value for key, value in _FILTERED.items() if key != "k_r"} | {"law": "press"}
_BAY = _PRESS | {"bay_compliance": True}
_MODAL = _BAY | {"wheel": "modal"}


@dataclass(frozen=True)
class Family:
    """A scheme but for its mesh and time step: what it is, what it leaves out, and its table."""

    words: str
    lacks: str
    table: Mapping[str, Any]


FAMILIES: Mapping[str, Family] = {
    "stiff": Family(
        "Euler beam, large constant k_r (our reading of the paper's scheme)",
        "the give of wheel and rail where they touch",
        _TANGENT | {"k_r": 1e11},
    ),
    "tangent": Family(
        "Euler beam, tangent of the static press",
        "the rail's shear, and its give between nodes",
        _TANGENT,
    ),
    "shear": Family(
        "Timoshenko beam with local compliance, tangent of the press",
        "the length of the patch: roughness is felt at a point",
        _SHEAR,
    ),
    "filtered": Family(
        "Timoshenko beam, tangent, roughness averaged over the patch",
        "the stiffening of the contact under load",
        _FILTERED,
    ),
    "press": Family(
        "Timoshenko beam, force-approach curve of the press, averaged roughness",
        "the give of web, foot and pads under the wheel over a bay",
        _PRESS,
    ),
    "bay": Family(
        "Timoshenko beam with the meshed rail's give over a bay, press, averaged",
        "the vibration of the wheel in itself",
        _BAY,
    ),
    "modal": Family(
        "the same beam, press and average, with the wheel's elastic modes",
        "the vibration of the rail's section",
        _MODAL,
    ),
    "solid": Family(
        "meshed rail, press, averaged roughness, the wheel's elastic modes",
        "the patch that moves and changes with the roughness below it",
        {k: v for k, v in _MODAL.items() if not k.endswith("_compliance")} | {"rail": "solid"},
    ),
}
"""Name -> family; each adds one thing to the one before."""
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
        return FAMILIES[self.family].words

    def toml(self, name: str = "point") -> str:
        """The table as it stands in a study file."""
        lines = [f"{key} = {_toml(value)}" for key, value in self.table.items()]
        return "\n".join([f"[runs.{name}]", *lines])


def schemes(time_step: float) -> dict[str, Scheme]:
    """Name -> all schemes, for a study of a time step [s]."""
    found = {}
    for family, made in FAMILIES.items():
        table = made.table
        for multiple in STEPS:
            # the journey's own step is no key of the run: it is what the study says
            step = {} if multiple == 1 else {"time_step": f"{1e6 * multiple * time_step:.6g} us"}
            for elements in ELEMENTS if table["rail"] != "solid" else (0,):
                mesh = {"elements_per_bay": elements} if elements else {}
                name = f"{family}_{elements}_{multiple}" if elements else f"{family}_{multiple}"
                found[name] = Scheme(family, {**table, **mesh, **step})
    return found


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"
