"""What all tables of a study file have in common."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict

from contactstudy.study import quantities as q

Condition = tuple[str, tuple[str, ...]]
"""A deciding key and the values of it with which another key applies."""


class Section(BaseModel):
    """A table of a study file: frozen, unknown keys forbidden."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)

    #: key -> (deciding key, its values): the key applies only then.
    applies: ClassVar[dict[str, Condition]] = {}

    def applicable(self, key: str) -> bool:
        """Whether the key (a field's name) means anything with the other values chosen."""
        if key not in self.applies:
            return True
        decider, values = self.applies[key]
        decided = decider not in type(self).model_fields or self.applicable(decider)
        return decided and getattr(self, decider) in values

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, as plain data."""
        dumped = self.model_dump(mode="json")
        fields = type(self).model_fields
        return {f.alias or k: dumped[k] for k, f in fields.items() if self.applicable(k)}

    def units(self) -> dict[str, str]:
        """Key -> SI unit of the keys in `resolved` that have one."""
        fields = {f.alias or name: f for name, f in type(self).model_fields.items()}
        return {key: unit for key in self.resolved() if (unit := q.unit_of(fields[key]))}
