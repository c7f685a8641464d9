"""What takes long to load is not loaded before it is needed."""

import subprocess
import sys

import pytest

HEAVY = {
    "bokeh", "fcl", "matplotlib", "meshio", "numba", "pandas", "pint", "scipy.interpolate",
    "scipy.optimize", "scipy.signal", "scipy.stats", "trimesh", "typst", "xarray",
}  # fmt: skip


def loaded(code: str) -> set[str]:
    script = f"import contextlib, io, sys\n{code}\nprint(*sys.modules)"
    made = subprocess.run([sys.executable, "-c", script], capture_output=True, check=True)
    return set(made.stdout.decode().split())


@pytest.mark.parametrize(
    ("code", "more"),
    [
        ("import contactstudy", {"numpy", "scipy"}),
        ("from contactstudy.solvers.point import point_contact", set()),
        ("import contactstudy.commands", {"numpy", "scipy"}),
        (
            "from contactstudy import cli\n"
            "with contextlib.redirect_stdout(io.StringIO()):\n"
            "    assert cli.main(['check', 'point_vs_surface']) == 0",
            set(),
        ),
    ],
    ids=["package", "point contact", "commands", "check"],
)
def test_what_is_heavy_waits(code, more):
    assert loaded(code) & (HEAVY | more) == set()
