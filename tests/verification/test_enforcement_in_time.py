"""Penalty, augmented Lagrangian, nodes and Gauss points over the same roughness."""

from functools import cache

import numpy as np
import xarray as xr

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.irregularity import paper_spectrum, sample_profile
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column

RECIPE = CellRecipe(size=0.004, interface_modes=8, internal_modes=4)
TOLERANCE = 1e-10


@cache
def bodies():  # type: ignore[no-untyped-def]
    track = SolidTrack(Track(solid_rail(RECIPE), length=4.8), condense(RECIPE))
    return track, elastic_wheel(WheelRecipe(size=0.004))


@cache
def run(quadrature: str, tolerance: float | None, penalty: float = 1e16) -> xr.Dataset:
    track, wheel = bodies()
    return surface_contact(
        track,
        SurfaceContact(wheel, penalty=penalty, quadrature=quadrature, tolerance=tolerance),
        wheel_column(),
        sample_profile(paper_spectrum(), seed=1),
        Journey(1.2, 2.0, fade_in=0.2),
    )


def dynamic(data: xr.Dataset) -> np.ndarray:
    return np.asarray(data.contact_force.values - data.attrs["static_load"][0])


def difference(one: xr.Dataset, other: xr.Dataset) -> float:
    a, b = dynamic(one), dynamic(other)
    return float(np.linalg.norm(a - b) / np.linalg.norm(b))


def test_nothing_is_left_of_the_penetration() -> None:
    for quadrature in ("nodes", "gauss"):
        plain, tight = run(quadrature, None), run(quadrature, TOLERANCE)
        print(f"{quadrature}: largest penetration {float(plain.penetration.max()):.3e} m")
        assert float(plain.penetration.max()) > 50e-9
        assert float(tight.penetration.max()) <= TOLERANCE
        assert float(tight.press_penetration.max()) <= TOLERANCE
        assert tight.attrs["law"] == "augmented Lagrangian"


def test_it_is_the_limit_of_the_penalty() -> None:
    limit = run("nodes", TOLERANCE)
    errors = [difference(run("nodes", None, e), limit) for e in (1e15, 1e16, 1e17)]
    print("dynamic part, penalty 1e15, 1e16, 1e17 Pa/m against the limit:", errors)
    np.testing.assert_allclose(np.log10(errors[:-1]) - np.log10(errors[1:]), 1.0, atol=0.1)


def test_the_limit_does_not_depend_on_the_penalty() -> None:
    assert difference(run("nodes", TOLERANCE, 1e15), run("nodes", TOLERANCE)) < 1e-5


def test_gauss_points_and_nodes_give_the_same_force() -> None:
    # at 4 mm, where the patch is three elements long and two to three wide
    found = difference(run("nodes", TOLERANCE), run("gauss", None))
    print(f"dynamic part, nodes against Gauss points at 4 mm: {100 * found:.2f} %")
    assert found < 0.01
