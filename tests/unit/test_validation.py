"""Parameters: the same limits for a caller from Python and for a table of a study file."""

from __future__ import annotations

import math
import pickle
from dataclasses import dataclass, field, replace
from typing import Annotated, Literal

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.units import UnitError
from contactstudy.validation import (
    Above,
    AtLeast,
    AtMost,
    By,
    Key,
    Naming,
    Parameters,
    Same,
    Unit,
    Variants,
    When,
    Written,
    by,
    complaint,
    entries,
    parameter,
    read,
    resolved,
    units,
)


@dataclass(frozen=True)
class Spring(Parameters):
    stiffness: Annotated[float, Unit("N/m"), Above(0), Key("spring_stiffness"), "of it"] = 2e6
    hidden: Annotated[float, Key("")] = 1.0


@dataclass(frozen=True)
class Damper(Parameters):
    damping: Annotated[float, Unit("N*s/m"), AtLeast(0)] = 3e3


def half(value: object, unit: str) -> object:
    if value == "third":
        raise UnitError("must be half")
    return 0.5 if value == "half" else value


@dataclass(frozen=True)
class Bed(Parameters):
    length: Annotated[float, Unit("m"), Above(0), "its length"] = 6.0
    start: Annotated[float, Unit("m"), AtLeast(0), Key("from"), "its start"] = 0.0
    kind: Annotated[Literal["soft", "stiff"], "what it is"] = "soft"
    depth: Annotated[float, Unit("m"), Above(0), When("kind", "soft")] = 0.3
    count: Annotated[int, AtLeast(1), AtMost(9), By("kind", soft=2, stiff=5)] = by()
    band: Annotated[tuple[float, float], Unit("rad/m"), Above(0)] = (0.1, 0.2)
    places: Annotated[tuple[float, ...], Unit("m"), AtLeast(0)] = ()
    sides: Annotated[tuple[Literal["left", "right"], ...], "which"] = ("left",)
    roll: Annotated[float | Literal["rest"], Unit("rad"), AtLeast(-1)] = "rest"
    share: Annotated[float, Written(half, '"half"')] = 1.0
    name: Annotated[str, "its name"] = ""
    flag: Annotated[bool, "on or off"] = False
    other: Annotated[float | None, Same(Spring, "stiffness")] = None
    layer: Annotated[
        Spring | Damper | None, Variants("layer", {"spring": Spring, "damper": Damper, "no": None})
    ] = field(default_factory=Spring)

    def problems(self, key: Naming) -> list[str]:
        if self.start < self.length:
            return []
        return [complaint(key("start"), self.start, f"must be below {key('length')}")]


@pytest.mark.parametrize(
    ("given", "problem"),
    [
        ({"length": -1}, "length = -1: must be above 0 m"),
        ({"length": "-1 mm"}, 'length = "-1 mm": must be above 0 m'),
        ({"length": "1 kg"}, "length = \"1 kg\": has the wrong unit 'kg'; allowed: m and"),
        ({"length": True}, "length = True: must be a number in m or text with a unit"),
        ({"length": math.nan}, "length = nan: must be finite (m)"),
        ({"from": 7.0}, "from = 7.0: must be below {}length"),
        ({"kind": "sotf"}, "kind = \"sotf\": must be \"soft\" or \"stiff\" (did you mean"),
        ({"kind": "stiff", "depth": 1}, 'depth: applies only with kind = "soft" (here "stiff")'),
        ({"count": 2.5}, "count = 2.5: must be a whole number at least 1 and at most 9"),
        ({"band": [1]}, "band.1: is missing"),
        ({"band": [1, 2, 3]}, "band = [1, 2, 3]: must be a list of 2 values"),
        ({"places": 3}, "places = 3: must be a list"),
        ({"places": np.array(3.0)}, "places = 3.0: must be a list"),
        ({"places": b"12"}, "places = b'12': must be a list"),
        ({"places": {1.0}}, "places = {{1.0}}: must be a list"),
        ({"kind": ["soft"]}, "kind = ['soft']: must be \"soft\" or \"stiff\""),
        ({"places": [1, -2]}, "places.1 = -2: must be at least 0 m"),
        ({"sides": ["rigt"]}, "sides.0 = \"rigt\": must be \"left\" or \"right\" (did you mean"),
        ({"roll": "stand"}, 'roll = "stand": must be a number in rad or text with a unit, or "r'),
        ({"share": "quarter"}, 'share = "quarter": must be a number, or "half"'),
        ({"share": "third"}, 'share = "third": must be half'),
        ({"name": 3}, "name = 3: must be text"),
        ({"flag": 1}, "flag = 1: must be true or false"),
        ({"other": -1}, "other = -1: must be above 0 N/m"),
    ],
)  # fmt: skip
def test_a_caller_from_python_gets_the_message_of_a_file(given, problem):
    problems = read(Bed, given, "bed")[1]
    assert len(problems) == 1
    assert problems[0].startswith("bed." + problem.format("bed.")), problems
    names = {"from": "start"}
    with pytest.raises(InputError) as caught:
        Bed(**{names.get(key, key): value for key, value in given.items()})
    (found,) = caught.value.problems
    assert found.replace("from", "start").startswith(
        "Bed." + problem.format("Bed.").replace("from", "start")
    )


def test_values_are_held_in_si():
    table = {"length": "50 mm", "from": 0, "band": ["1 rad/m", 2], "share": "half", "count": "3"}
    made, problems = read(Bed, table, "bed")
    assert not problems
    assert (made.length, made.start, made.band, made.share) == (0.05, 0.0, (1.0, 2.0), 0.5)
    assert made.count == 3 and made == Bed("50 mm", band=(1, 2), share="half", count=3)
    assert pickle.loads(pickle.dumps(made)) == made and hash(made) == hash(replace(made))


def test_arrays_and_ranges_are_lists():
    assert Bed(places=np.array([1.0, 2.0])).places == Bed(places=range(1, 3)).places == (1.0, 2.0)


def test_a_default_by_another_value():
    assert Bed().count == 2 and Bed(kind="stiff").count == 5
    assert read(Bed, {"kind": "stiff"}, "bed")[0].count == 5
    assert Bed(kind="stiff", count=2).count == 2


def test_a_key_chooses_a_class():
    made, problems = read(Bed, {"layer": "damper", "damping": "4 kN s/m"}, "bed")
    assert not problems and made.layer == Damper(4e3)
    assert read(Bed, {"layer": "no"}, "bed")[0].layer is None
    for table, problem in (
        ({"damping": 1}, 'bed.damping: applies only with layer = "damper" (here "spring")'),
        ({"layer": "sprng"}, "bed.layer = \"sprng\": must be \"spring\", \"damper\" or \"no\" ("),
        ({"layer": "damper", "damping": -1}, "bed.damping = -1: must be at least 0 N*s/m"),
        ({"spring_stifness": 1}, "bed.spring_stifness: unknown key (did you mean 'spring_stiff"),
        ({"hidden": 1}, "bed.hidden: unknown key; allowed: length, from, kind"),
    ):  # fmt: skip
        (found,) = read(Bed, table, "bed")[1]
        assert found.startswith(problem)
    with pytest.raises(InputError, match="must be of type Spring or Damper or None"):
        Bed(layer="spring")


def test_keys_of_other_classes_are_not_offered():
    (found,) = read(Bed, {"zzz": 1}, "bed")[1]
    assert "spring_stiffness" in found and "damping" not in found
    (found,) = read(Bed, {"layer": "damper", "zzz": 1}, "bed")[1]
    assert "spring_stiffness" not in found and found.endswith("layer, damping")


def test_a_wrong_deciding_key_hides_no_other_problem():
    table = {"layer": "rubber", "damping": -1, "spring_stiffness": 5}
    choice, value = read(Bed, table, "bed")[1]
    assert choice.startswith('bed.layer = "rubber"') and value.startswith("bed.damping = -1: must")


def test_everything_wrong_at_once():
    table = {"length": -1, "layer": "damper", "damping": -1, "spring_stiffness": 1, "zzz": 0}
    assert len(read(Bed, table, "bed")[1]) == 4
    with pytest.raises(InputError) as caught:
        Bed(-1, flag="yes")
    assert len(caught.value.problems) == 2
    assert read(Bed, 3, "bed") == (None, ["bed = 3: must be a table"])


def test_keys_values_and_units():
    known = entries(Bed)
    assert known["spring_stiffness"].conditions == (("layer", ("spring",)),)
    assert known["depth"].conditions == (("kind", ("soft",)),)
    assert known["from"].parameter.meaning == "its start" and known["layer"].conditions == ()
    assert parameter(Bed, "other").unit == "N/m"
    values = resolved(Bed, Bed(kind="stiff", roll=0.1))
    assert "depth" not in values and "hidden" not in values and "damping" not in values
    assert values["layer"] == "spring" and values["band"] == [0.1, 0.2]
    assert units(Bed, values) == {
        "length": "m", "from": "m", "band": "rad/m", "places": "m", "roll": "rad",
        "other": "N/m", "spring_stiffness": "N/m",
    }  # fmt: skip
    assert "roll" not in units(Bed, resolved(Bed, Bed()))
