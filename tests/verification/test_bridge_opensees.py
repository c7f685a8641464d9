"""A two-span bridge in space under axle loads beside its axis, against OpenSees.

`opensees_bridge/recipe.py` made the stored figures: deck of `elasticBeamColumn` elements, lumped
masses, the loads straight on the deck. Here they roll on two rails on stiff, close supports.
"""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from contactstudy.contact.laws import MovingForce
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.point import point_contact
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import GivenDeck
from contactstudy.track.model import Ballast, DiscreteSupports, GivenRail, Track
from contactstudy.track.space_beam import displacement
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import AxleLoads

STORED = Path(__file__).parent / "opensees_bridge"
CASE = tomllib.loads((STORED / "case.toml").read_text())
BEFORE = 12.0  # m, approach
DECK = ("youngs_modulus", "poisson_ratio", "area", "second_moment", "lateral_second_moment",
        "torsion_constant", "mass_per_length", "damping_ratio")  # fmt: skip


def bridge_with_track(spacing: float) -> StructureTrack:
    """The case, with rails of no mass that hardly stiffen the deck, in the deck's plane."""
    layer = Ballast(stiffness=1e10, damping=0.0, lateral_stiffness=1e10, lateral_damping=0.0)
    supports = DiscreteSupports(
        spacing=spacing,
        pad_stiffness=1e10,
        pad_damping=0.0,
        pad_length=0.0,
        sleeper_mass=0.0,
        layer=layer,
    )
    bridge = Bridge(
        spans=tuple(CASE["spans"]),
        spans_per_deck=(2,),
        deck=GivenDeck(**{name: CASE[name] for name in DECK}),
        damping_frequencies=tuple(CASE["damping_frequencies"]),
        approach_before=BEFORE,
        approach_behind=BEFORE,
        track_offset=CASE["offset"],
        track_height=0.0,
        bearing_depth=0.0,
        bearing_stiffness=1e14,
        lateral_bearing_stiffness=1e12,
    )
    rail = GivenRail(EI=2e5, mass=1e-3, area=1e-4)
    track = Track(rail=rail, support=supports, structure=bridge)
    return StructureTrack(track, planar=False, elements_per_bay=1)


def histories(structure: StructureTrack) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """X of the first load (n,), deflection and acceleration (n, k) of the deck below the track."""
    row, seen = displacement("Z", (0.0, CASE["offset"], 0.0)), []
    deck, stations = structure.nodes.decks[0], BEFORE + np.array(CASE["stations"])
    dofs, weights = structure.rows_of(deck, stations, row)
    data = point_contact(
        structure,
        AxleLoads(
            axle_loads=(CASE["load"],) * len(CASE["distances"]),
            axle_distances=tuple(np.diff(CASE["distances"])),
        ).vehicle(2),
        SmoothRail(),
        Journey(
            start=BEFORE + CASE["start"],
            end=BEFORE + CASE["end"],
            speed=CASE["speed"],
            time_step=CASE["time_step"],
            fade_in=0.0,
        ),
        law=MovingForce(),
        observers=(EachState(lambda state: seen.append((state.u[dofs], state.a[dofs]))),),
    )
    u, a = np.einsum("nskd,kd->snk", np.array(seen), weights)
    return data.position.values[0] - BEFORE, u, a


def test_eccentric_loads_on_two_spans_against_opensees():
    x, u, a = histories(bridge_with_track(0.125))
    low = signal.butter(4, 30.0, fs=1.0 / CASE["time_step"], output="sos")
    ours = np.hstack([1e3 * u, signal.sosfiltfilt(low, a, axis=0)])
    stored = np.loadtxt(STORED / "result.csv", delimiter=",", skiprows=1)
    assert np.ptp(stored[:, 0]) == pytest.approx(CASE["end"] - CASE["start"], abs=0.4)
    for k, name in enumerate(("u 1", "u 2", "a 1", "a 2")):
        theirs, mine = stored[:, k + 1], np.interp(stored[:, 0], x, ours[:, k])
        largest = np.abs(theirs).max()
        peak, most = np.abs(mine).max() / largest - 1.0, np.abs(mine - theirs).max() / largest
        print(f"{name}: largest {largest:.4g}, peak {100 * peak:+.2f} %, most {100 * most:.2f} %")
        assert abs(peak) < 0.005
        assert most < 0.005
