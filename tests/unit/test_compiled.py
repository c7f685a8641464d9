"""What numba keeps on disk, against edits of the functions that are compiled into others."""

import os
import subprocess
import sys
from pathlib import Path

import contactstudy

INNER = """
from contactstudy.compiled import compiled

@compiled
def factor(x: float) -> float:
    return {factor} * x
"""
OUTER = """
from contactstudy.compiled import compiled
from inner import factor

@compiled
def plus_one(x: float) -> float:
    return factor(x) + 1.0

@compiled
def twice(x: float) -> float:
    return plus_one(plus_one(x))
"""
MIDDLE = """
from contactstudy.compiled import compiled
from outer import twice

@compiled
def result(x: float) -> float:
    return twice(x)

{first}
print(result(1.0))
"""


def test_an_edit_of_a_function_in_another_module_is_seen(tmp_path):
    """Two modules down, and also where the inner one is compiled already."""
    (tmp_path / "outer.py").write_text(OUTER)
    environment = os.environ | {"PYTHONPATH": str(Path(contactstudy.__file__).parents[1])}
    compiled_before = "from inner import factor; factor(1.0)"
    for first, value in (("", 2.0), ("", 3.0), (compiled_before, 4.0)):
        (tmp_path / "main.py").write_text(MIDDLE.format(first=first))
        (tmp_path / "inner.py").write_text(INNER.format(factor=value))
        ran = subprocess.run(
            [sys.executable, "-B", "main.py"],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
        )
        expected = value * (value + 1.0) + 1.0
        assert float(ran.stdout or "nan") == expected, ran.stderr
    assert list(tmp_path.rglob("*.nbi"))  # there was something kept that could be old
