"""A kind of study whose results have a closed form."""

import sys

import pytest

from contactstudy.study import kind

# A power law y = scale * x^order + offset, sampled; what is measured of it is its largest value.
LAW = '''
"""Powers: values with a closed form."""
import dataclasses
import os
import typing
from typing import Annotated

import numpy as np
import xarray as xr

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.report.blocks import text
from contactstudy.study.axes.measured import measured
from contactstudy.study.kind import Kind, Report, Work
from contactstudy.study.overrides import override
from contactstudy.study.study import Study
from contactstudy.validation import Above, AtLeast, Parameters, Unit, raise_if, read


@dataclasses.dataclass(frozen=True)
class Law(Parameters):
    """Numbers of a power law."""

    x: Annotated[float, Unit("m"), Above(0), "step"] = 1.0
    order: Annotated[float, Above(0), "exponent"] = 2.0
    scale: Annotated[float, "factor"] = 1.0
    seed: Annotated[int, AtLeast(0), "of a normal deviate"] = 0
    breaks_at: Annotated[float, Unit("m"), "x at which it breaks down"] = -1.0
    dies_at: Annotated[int, "seed at which its process ends"] = -1
    word: Annotated[str, "any"] = ""

    def problems(self, key):
        if self.x > 100 * self.order:
            return [f"{key('x')} = {self.x:g}: must be below 100 times {key('order')}"]
        return []


@dataclasses.dataclass(frozen=True)
class Powers(Study):
    kind: typing.ClassVar[str] = "law"
    law: Law = Law()

    def config(self):
        return {"law": self.law.resolved()}

    def units(self):
        return {"law.x": "m"}


def compute(study, name, progress):
    law = study.law
    if law.x == law.breaks_at:
        raise NumericalError(f"x = {law.x:g} m breaks down")
    if law.seed == law.dies_at:
        os.kill(os.getpid(), 9)
    if name == "shared":
        return xr.Dataset({"y": ("k", [law.scale])})
    noise = np.random.default_rng(law.seed).normal() if law.seed else 0.0
    value = 5.0 + law.scale * law.x**law.order + noise
    return xr.Dataset({"y": ("k", value * np.arange(1, 4) / 3)}, {"k": [0, 1, 2]})


def measure(study, found):
    if study.law.word == "odd":
        raise InputError("cannot be measured")
    largest = {name: float(run.y.max()) for name, run in found.items()}
    return {"largest": measured("m", "largest y", ["run"], largest)}


class LawKind(Kind):
    name = "law"
    computing = "law_kind:compute"
    measuring = "law_kind:measure"
    tables: typing.ClassVar = {"law": Law}

    def load(self, path, data, overrides, main=None):
        problems = override(data, overrides, self.tables)
        law, wrong = read(Law, data.get("law", {}), "law")
        raise_if(problems + wrong)
        return Powers(path.stem, "Powers", law=law)

    def work(self, study, inputs):
        own = study.config()["law"]
        batch = "any" if own["word"] == "batch" else ""
        yield Work("shared", own["scale"], light=True)
        yield Work("power", own, light=True, batch=batch)

    def report(self, results, timings=False):
        return Report(["Powers."], [{"title": "Powers", "blocks": [text("They grow.")]}])


LAW = LawKind()
'''


@pytest.fixture
def law(tmp_path, monkeypatch):
    """Write a study of the kind with further lines; gives its path."""
    (tmp_path / "law_kind.py").write_text(LAW)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))  # of worker processes
    monkeypatch.setitem(kind.KINDS, "law", "law_kind:LAW")

    def written(text: str = "", own: str = "", name: str = "powers"):
        path = tmp_path / f"{name}.toml"
        path.write_text(f"[law]\n{own}\n{text}")
        return path

    yield written
    sys.modules.pop("law_kind", None)
