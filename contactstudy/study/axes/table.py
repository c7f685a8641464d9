"""The tables ``[sweep]``, ``[refine]`` and ``[quick]`` of a study file of any kind."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from contactstudy.study.axes.design import (
    COMBINATIONS,
    GRID,
    LATIN,
    SOBOL,
    SWEEP,
    ZIP,
    Design,
)  # fmt: skip
from contactstudy.study.axes.distributions import Quantile, distribution, points
from contactstudy.study.axes.keys import ABOUT, find_parameter
from contactstudy.study.axes.series import MOST, Series, series
from contactstudy.study.kind import Kind
from contactstudy.units import Limits, UnitError
from contactstudy.validation import Parameter, complaint, unknown
from contactstudy.validation.messages import any_of

_DRAWN = (SOBOL, LATIN)
_SETTINGS = ("combine", "samples", "seed", "keep")
# keys that are finer where they are smaller, whatever else is; of others both ways make sense
_FINER_WHERE_SMALLER = re.compile(r"\.(time_step|(coarse_)?mesh_size|cell)$")
_ANY = Parameter("", "", float, None, Limits())


def read_designs(
    data: Mapping[str, Any], kind: Kind, base: Path
) -> tuple[list[Design], tuple[str, ...], list[str]]:
    """The designs of a study file, what is kept whole, and everything that is wrong.

    Files among the values are relative to the folder `base`. Nothing is made of a design that is
    too large.
    """
    reader = _Reader(kind, data, base)
    sweep, refine = data.get("sweep", {}), data.get("refine", {})
    for name, table in (("sweep", sweep), ("refine", refine)):
        if not isinstance(table, Mapping):
            return [], (), [complaint(name, table, "must be a table")]
    swept, combine, keep = reader.swept(sweep)
    refined, expected, why = reader.refined(refine)
    problems = reader.problems
    problems += [
        f"{key}: stands in [sweep] and in [refine]; must be in one"
        for key in refined
        if key in swept
    ]
    designs = [
        Design(
            f"refine.{key}", swept | {key: found}, combine, key, expected.get(key), why.get(key, "")
        )
        for key, found in refined.items()
    ]
    if swept and not refined:
        designs = [Design(SWEEP, swept, combine)]
    total = sum(map(len, designs)) if not problems else 0
    if total > MOST:
        sizes = "; ".join(" x ".join(map(str, d.sizes.values())) for d in designs)
        problems.append(f"sweep: {total} variants ({sizes}); allowed are {MOST}")
    return designs, keep, problems


class _Reader:
    """Reads the tables of one file; collects complaints."""

    def __init__(self, kind: Kind, data: Mapping[str, Any], base: Path) -> None:
        self._kind, self._data, self._base = kind, data, base
        self.problems: list[str] = []

    def swept(self, table: Mapping[str, Any]) -> tuple[dict[str, Series], str, tuple[str, ...]]:
        """Series of each key, how they are combined, and names of the histories to keep."""
        keys = {k: v for k, v in table.items() if "." in k}
        self._no_settings("sweep", table, _SETTINGS)
        combine, keep = table.get("combine", GRID), table.get("keep", [])
        if combine not in COMBINATIONS:
            self._wrong("sweep.combine", combine, f"must be {any_of(COMBINATIONS)}")
            combine = GRID
        if not isinstance(keep, list) or not all(isinstance(k, str) for k in keep):
            self._wrong("sweep.keep", keep, "must be a list of names of histories")
            keep = []
        drawn = combine in _DRAWN
        if not drawn:
            for name in ("samples", "seed"):
                if name in table:
                    self._wrong(f"sweep.{name}", table[name], f'means nothing with "{combine}"')
            distinct = combine != ZIP
            found = {k: s for k, v in keys.items() if (s := self._series("sweep", k, v, distinct))}
            if combine == ZIP and len({len(s) for s in found.values()}) > 1:
                lengths = ", ".join(f"{k} {len(s)}" for k, s in found.items())
                self.problems.append(f"sweep: zipped series must be equally long ({lengths})")
        else:
            found = self._samples(keys, combine, table)
        if table and not keys:
            self.problems.append('sweep: names no key; dotted keys are quoted: "journey.speed"')
        return found, combine, tuple(keep)

    def refined(
        self, table: Mapping[str, Any]
    ) -> tuple[dict[str, Series], dict[str, float], dict[str, str]]:
        """Series of each refined key, the expected orders, and why it is those or none."""
        self._no_settings("refine", table, ABOUT)
        found = {}
        for key, value in table.items():
            if "." not in key or (made := self._series("refine", key, value)) is None:
                continue
            x = made.coordinates
            steps = {b > a for a, b in pairwise(x)} if made.numeric else set()
            counts = (parameter := self._parameter("refine", key)) and parameter.limits.whole
            falls = _FINER_WHERE_SMALLER.search(key) is not None
            wrong = made.numeric and ((counts and x[0] > x[-1]) or (falls and x[0] < x[-1]))
            if len(made) < 2 or len(steps) != 1 or wrong or min(x) <= 0.0:
                way = "increasing" if counts else "decreasing" if falls else ""
                more = f", that is {way}" if way else ""
                allowed = f"must be 2 or more numbers above 0, coarse to fine{more}"
                self._wrong(f"refine.{key}", value, allowed)
                continue
            found[key] = made
        orders, why = dict[str, float](), dict[str, str]()
        for key, value in self._by_key(table, "expected", "orders").items():
            try:
                orders[key] = float(Limits(above=0.0)(value))
            except UnitError as error:
                self._wrong(f"refine.expected.{key}", value, str(error))
        for key, value in self._by_key(table, "why", "texts").items():
            if isinstance(value, str):
                why[key] = " ".join(value.split())
            else:
                self._wrong(f"refine.why.{key}", value, "must be text")
        return found, orders, why

    def _by_key(self, table: Mapping[str, Any], name: str, what: str) -> Mapping[str, Any]:
        """A table of the refinements that says something of keys, and of those that it refines."""
        found = table.get(name, {})
        if not isinstance(found, Mapping):
            self._wrong(f"refine.{name}", found, f"must be a table of {what} by key")
            return {}
        keys = [key for key in table if "." in key]
        self.problems += [unknown(f"refine.{name}", k, keys) for k in found if k not in keys]
        return found

    def _samples(self, keys: Mapping[str, Any], combine: str, table: Mapping[str, Any]) -> Any:
        number = self._whole(table, "samples", 64, 2)
        seed = self._whole(table, "seed", 1, 0)
        if combine == SOBOL and number & (number - 1):
            self._wrong("sweep.samples", number, "must be a power of 2 with Sobol's points")
        drawn: dict[str, Quantile | Series | None] = {}
        for key, value in keys.items():
            parameter = self._parameter("sweep", key)
            if parameter is None:
                continue
            try:
                drawn[key] = distribution(value, parameter) or self._series("sweep", key, value)
            except UnitError as error:
                self._wrong(f"sweep.{key}", value, str(error))
        if self.problems or number > MOST or not drawn:
            return {}
        unit_cube = points(combine, len(drawn), number, seed)
        found = {}
        for (key, how), p in zip(drawn.items(), unit_cube.T, strict=True):
            parameter = self._parameter("sweep", key) or _ANY
            if isinstance(how, Series):  # each of the listed values equally likely
                at = [min(int(len(how) * q), len(how) - 1) for q in p]
                values = tuple(how.values[k] for k in at)
                found[key] = Series(
                    values, tuple(how.coordinates[k] for k in at), how.unit, how.factor_of
                )
            elif how is not None:
                numbers = [float(f"{x:.12g}") for x in how(p)]
                made = tuple(map(int, numbers) if parameter.limits.whole else numbers)
                found[key] = Series(made, made, parameter.unit)
        return found

    def _whole(self, table: Mapping[str, Any], name: str, default: int, least: int) -> int:
        try:
            return int(
                Limits(whole=True, at_least=least, at_most=max(MOST, 2**32))(
                    table.get(name, default)
                )
            )
        except UnitError as error:
            self._wrong(f"sweep.{name}", table[name], str(error))
            return default

    def _series(self, table: str, key: str, value: Any, distinct: bool = True) -> Series | None:
        parameter = self._parameter(table, key)
        if parameter is None:
            return None
        try:
            if isinstance(value, Mapping):
                raise UnitError("must be a list or a range; a dotted key is quoted")
            if parameter.file:
                value = [
                    self._file(parameter, v)
                    for v in (value if isinstance(value, list) else [value])
                ]
            elif distribution(value, parameter) is not None:
                raise UnitError(f"is drawn only in [sweep] with combine = {any_of(_DRAWN)}")
            return series(value, parameter, distinct)
        except UnitError as error:
            self._wrong(f"{table}.{key}", value, str(error))
            return None

    def _file(self, parameter: Parameter, name: Any) -> Any:
        assert parameter.file is not None
        relative = isinstance(name, str) and (Path(name).suffix if parameter.file.or_name else name)
        return str(self._base / name) if relative else name

    def _parameter(self, table: str, key: str) -> Parameter | None:
        found = find_parameter(key, self._kind, self._data)
        if isinstance(found, Parameter):
            return found
        text = f"{table}: {found}"
        self.problems += [text] if text not in self.problems else []
        return None

    def _no_settings(self, name: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
        wrong = [k for k in table if "." not in k and k not in known]
        for key in wrong:
            if isinstance(table[key], Mapping):  # a bare dotted key makes tables in tables
                self.problems.append(f'{name}.{key}: dotted keys are quoted: "{key}.KEY" = ...')
            else:
                self.problems.append(unknown(name, key, known))

    def _wrong(self, path: str, value: Any, allowed: str) -> None:
        self.problems.append(complaint(path, value, allowed))
