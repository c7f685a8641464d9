"""Cost of the static press against CalculiX on the same mesh: 2 mm, 0.4 m of rail.

    pytest benchmarks/test_calculix.py --benchmark-only -s

Processor time on one thread each, so that what else runs on the machine matters little. The
program's targets: at least 20 times faster than CalculiX once its bodies are condensed, and
condensing them no slower than one CalculiX solution. Takes some minutes, nearly all CalculiX's.
"""

import shutil
import time

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.export.calculix import PressLoading, calculix_input
from contactstudy.export.press_mesh import press_mesh
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import elastic_wheel
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solvers.at_rest import geometry_press
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column
from contactstudy.verification.cases.run_calculix import run_calculix

CELL, WHEEL, LENGTH, PENALTY = CellRecipe(), WheelRecipe(), 0.4, 1e16
LOAD = float(wheel_column().static_loads[0])


def seconds(run):
    """Result of a call and its processor time on one thread."""
    with threadpool_limits(1):
        began = time.process_time()
        result = run()
        return result, time.process_time() - began


@pytest.mark.skipif(shutil.which("ccx") is None, reason="needs the program ccx (CalculiX)")
def test_static_press(benchmark):
    cell, rail_time = seconds(lambda: condense(CELL))
    wheel, wheel_time = seconds(lambda: elastic_wheel(WHEEL))
    described = Track(rail=solid_rail(CELL), length=LENGTH, support=None)

    def ours():
        # a new track each time: its assembly and factor belong to the press
        track = SolidTrack(described, cell)
        return geometry_press(
            track, SurfaceContact(wheel, penalty=PENALTY), np.array([LOAD]), x=0.5 * LENGTH
        )

    curve = ours()  # compiled kernels are loaded
    times = []

    def timed():
        times.append(seconds(ours)[1])

    benchmark.pedantic(timed, rounds=5)
    press_time = float(np.median(times))

    start = hertz_contact(LOAD, contact_modulus(), WHEEL.dimensions.radius, 0.3).approach
    loading = PressLoading(LOAD, PENALTY, start)
    text = calculix_input(press_mesh(CELL, WHEEL, LENGTH), loading, 210e9, 0.3, ["benchmark"])
    theirs = run_calculix(text, PENALTY)
    approach = curve.solutions[0].approach
    condensing = rail_time + wheel_time
    benchmark.extra_info |= {
        "calculix_s": round(theirs.cpu_seconds, 1),
        "press_s": round(press_time, 3),
        "condensing_s": round(condensing, 1),
        "calculix_over_press": round(theirs.cpu_seconds / press_time),
        "calculix_over_condensing": round(theirs.cpu_seconds / condensing, 1),
    }
    print(
        f"\nCalculiX {theirs.cpu_seconds:.0f} s ({theirs.solutions} systems solved), "
        f"hub {1e6 * theirs.press.approach:.2f} um"
        f"\npress {press_time:.3f} s, hub {1e6 * approach:.2f} um: "
        f"{theirs.cpu_seconds / press_time:.0f} times faster"
        f"\ncondensing rail {rail_time:.1f} s and wheel {wheel_time:.1f} s: "
        f"{theirs.cpu_seconds / condensing:.1f} times faster"
    )
