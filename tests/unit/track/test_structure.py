"""The track on a bridge: its parts against closed forms and against the track on the ground."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse.linalg as spla

from contactstudy.exceptions import InputError
from contactstudy.track.beam import BeamTrack
from contactstudy.track.bridge import Bridge, stretches
from contactstudy.track.deck import Antoing, Box32m, GivenDeck, rayleigh, realised_ratio
from contactstudy.track.model import Ballast, DiscreteSupports, Slab, Track, WinklerFoundation
from contactstudy.track.pier import Pier
from contactstudy.track.receptance import receptance
from contactstudy.track.space_beam import N_DOFS, UX, UY, UZ, displacement
from contactstudy.track.structure import LEFT, RIGHT, StructureTrack
from contactstudy.track.structure_springs import FOOT_DEPTH, all_springs, bearings

SOFT = DiscreteSupports(
    pad_stiffness=1e2,
    lateral_pad_stiffness=1e2,
    pad_length=0.0,
    layer=Ballast(stiffness=1e2, lateral_stiffness=1e2),
)
"""Pads with which the rails do not hold a deck."""
STIFF = {"bearing_stiffness": 1e14, "lateral_bearing_stiffness": 1e14}


def on_bridge(support=None, **bridge):
    return Track(support=support or DiscreteSupports(), structure=Bridge(**bridge))


def written_out(rows, n):
    dofs, weights = rows
    full = np.zeros((len(dofs), n))
    for row, d, w in zip(full, dofs, weights, strict=True):
        np.add.at(row, d, w)
    return full


def deck_row(structure, x, axis, arm=(0.0, 0.0, 0.0), deck=0):
    row = displacement(axis, arm)
    return written_out(
        structure.rows_of(structure.nodes.decks[deck], np.atleast_1d(x), row), structure.n_dofs
    )


def deck_turn(structure, x, dof, deck=0):
    chain = structure.nodes.decks[deck]
    return written_out(structure.rows_of(chain, np.atleast_1d(x), np.eye(6)[dof]), structure.n_dofs)


def statics(structure, load):
    return spla.spsolve(structure.stiffness.tocsc(), load)


@pytest.mark.parametrize("layer", ["ballast", "slab"])
@pytest.mark.parametrize("pad", [0.0, 0.16])
@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
def test_on_the_ground_it_is_twice_the_track_of_one_rail(layer, pad, theory):
    support = DiscreteSupports(pad_length=pad, **({"layer": Slab()} if layer == "slab" else {}))
    track = on_bridge(support, spans=(2.4,), approach_before=60.0, approach_behind=12.0)
    structure = StructureTrack(track, theory, 4)
    beam = BeamTrack(Track(support=support, length=60.0), theory, 4)
    # on a slab waves above 100 Hz come back from the ends, whose seats do not stand alike
    f = np.array([5.0, 60.0, 180.0, 700.0] if layer == "ballast" else [5.0, 60.0])
    # seats of the bridge's track stand in the middle of the bays
    for x in (29.7, 29.91, 30.0):
        np.testing.assert_allclose(
            2.0 * receptance(structure, x, f), receptance(beam, x + 0.3, f), rtol=2e-6
        )


def test_in_space_the_sum_over_both_rails_is_the_planar_motion():
    """Without springs along the track, which stiffen it, and with the track in the middle."""
    support = DiscreteSupports(lateral_pad_stiffness=1.0)
    track = on_bridge(
        support,
        spans=(6.0, 12.0),
        track_offset=0.0,
        approach_before=12.0,
        approach_behind=12.0,
        track_height=0.0,
        bearing_depth=0.0,
        entry_length=1.0,
    )
    planar, space = StructureTrack(track), StructureTrack(track, planar=False)
    for x in (7.3, 15.1, 24.0):
        row = written_out(planar.rail_rows(np.array([x])), planar.n_dofs)[0]
        both = sum(
            written_out(space.contact_rows(np.array([x]), rail, "Z"), space.n_dofs)[0]
            for rail in (RIGHT, LEFT)
        )
        assert 0.5 * both @ statics(space, 0.5 * both) == pytest.approx(
            row @ statics(planar, row), rel=1e-4
        )


def test_parts_move_as_one_without_a_force():
    """A rigid motion of all stretches no pad, bed or bearing: rigid offsets are consistent."""
    structure = StructureTrack(
        on_bridge(spans=(6.0, 9.0), approach_before=12.0, approach_behind=12.0, piers=Pier()),
        planar=False,
    )
    nodes, bridge = structure.nodes, structure.bridge
    place = np.column_stack([nodes.x, np.zeros((nodes.n, 2))])
    for rail, y in zip(nodes.rails, bridge.lateral_of_rails, strict=True):
        place[rail.nodes, 1:] = y, bridge.track_height + FOOT_DEPTH
    for k in range(len(nodes.layers)):
        place[nodes.layers[k].nodes, 1:] = bridge.track_offset, bridge.track_height
    for pier in nodes.piers:
        place[pier.nodes[1], 2] = -bridge.bearing_depth
    rng = np.random.default_rng(1)
    shift, turn = rng.normal(size=3), rng.normal(size=3)
    motion = np.hstack([shift + np.cross(turn, place), np.tile(turn, (nodes.n, 1))]).ravel()
    held = 0
    for spring in all_springs(nodes, planar=False):
        elongation = spring.rows @ motion
        for row in range(len(elongation)):
            of = slice(*spring.rows.indptr[row : row + 2])
            # both rails are of one kind; what touches one kind of node only stands on the ground
            kinds = np.unique(np.maximum(nodes.rank[spring.rows.indices[of] // N_DOFS], 1))
            if len(kinds) == 2:
                assert elongation[row] == pytest.approx(0.0, abs=1e-11)
            else:
                held += 1
    assert held > 0


@pytest.mark.parametrize("planar", [True, False])
def test_a_simply_supported_deck_bends_as_its_closed_form(planar):
    L, P = 32.0, 1e6
    structure = StructureTrack(on_bridge(SOFT, spans=(L,), **STIFF), planar=planar)
    deck, middle = structure.bridge.deck, structure.bridge.approach_before + L / 2
    row = deck_row(structure, middle, "Z")[0]
    expected = P * L**3 / (48 * deck.youngs_modulus * deck.second_moment)
    assert P * row @ statics(structure, row) == pytest.approx(expected, rel=1e-4)


def test_an_eccentric_load_twists_a_deck_held_at_both_ends():
    L, P, e = 32.0, 1e6, 2.5
    structure = StructureTrack(on_bridge(SOFT, spans=(L,), **STIFF), planar=False)
    deck, before = structure.bridge.deck, structure.bridge.approach_before
    a = structure.nodes.decks[0].x[20] - before  # twist is linear between nodes
    load = P * deck_row(structure, before + a, "Z", (0.0, e, 0.0))[0]
    u = statics(structure, load)
    G = deck.youngs_modulus / (2 * (1 + deck.poisson_ratio))
    expected = P * e * a * (L - a) / (L * G * deck.torsion_constant)
    assert (deck_turn(structure, before + a, 3) @ u)[0] == pytest.approx(expected, rel=1e-4)
    # and an edge of the deck moves by bending and twist
    bent = P * a**2 * (L - a) ** 2 / (3 * deck.youngs_modulus * deck.second_moment * L)
    edge = (deck_row(structure, before + a, "Z", (0.0, 6.0, 0.0)) @ u)[0]
    assert edge == pytest.approx(bent + 6.0 * expected, rel=1e-4)


def test_two_bearings_of_a_support_hold_a_deck_against_twist():
    """Statics: R = P (L - a)/L and T = e R at the nearer end, R/2 + T/b on the loaded side."""
    L, P, e, b = 32.0, 1e6, 3.0, 4.0
    bridge = on_bridge(SOFT, spans=(L,), bearing_distance=b, **STIFF)
    structure = StructureTrack(bridge, planar=False)
    a = structure.nodes.decks[0].x[20] - structure.bridge.approach_before
    at = structure.bridge.approach_before + a
    u = statics(structure, -P * deck_row(structure, at, "Z", (0.0, e, 0.0))[0])
    right, left = (
        -one.springs.stiffness * (structure._frame.selected(one.springs.rows) @ u)
        for one in bearings(structure.nodes, ("Z",))
    )
    ends = P * np.array([L - a, a]) / L
    np.testing.assert_allclose(left, ends * (0.5 + e / b), rtol=1e-3)
    np.testing.assert_allclose(right, ends * (0.5 - e / b), rtol=1e-3)  # e > b/2: it lifts
    together = structure.bearing_rows("Z")[0] @ u  # positive in tension
    np.testing.assert_allclose(together, -ends, rtol=1e-3)


def test_lateral_load_above_the_deck_bends_it_sideways_and_twists_it():
    L, P, h = 32.0, 1e6, 3.0
    structure = StructureTrack(
        on_bridge(SOFT, spans=(L,), bearing_depth=0.0, **STIFF), planar=False
    )
    deck, middle = structure.bridge.deck, structure.bridge.approach_before + L / 2
    assert middle == pytest.approx(structure.nodes.decks[0].x[27])  # of 53 seats and both ends
    u = statics(structure, P * deck_row(structure, middle, "Y", (0.0, 0.0, h))[0])
    G = deck.youngs_modulus / (2 * (1 + deck.poisson_ratio))
    bent = P * L**3 / (48 * deck.youngs_modulus * deck.lateral_second_moment)
    assert (deck_row(structure, middle, "Y") @ u)[0] == pytest.approx(bent, rel=1e-4)
    twist = -P * h * L / (4 * G * deck.torsion_constant)
    assert (deck_turn(structure, middle, 3) @ u)[0] == pytest.approx(twist, rel=1e-4)


def test_rails_above_the_axis_stiffen_the_deck_as_a_composite_section():
    """Rails tied rigidly to the deck along the track: EI grows by about EA_r h^2 of both."""
    L, h = 32.0, 3.0
    stiff = DiscreteSupports(
        spacing=0.5,
        pad_stiffness=1e11,
        lateral_pad_stiffness=1e12,
        pad_length=0.0,
        layer=Slab(
            bending_stiffness=1.0,
            lateral_bending_stiffness=1.0,
            stiffness=1e12,
            lateral_stiffness=1e13,
        ),
    )
    loose = replace(stiff, lateral_pad_stiffness=1.0)
    given = {
        "spans": (L,),
        "track_height": h - FOOT_DEPTH,
        "track_offset": 0.0,
        "bearing_depth": 0.0,
        **STIFF,
    }
    deck = GivenDeck(area=2.0, second_moment=0.1, lateral_second_moment=1.0, torsion_constant=1.0)
    sag = []
    for support in (stiff, loose):
        structure = StructureTrack(on_bridge(support, deck=deck, **given), planar=False)
        row = deck_row(structure, structure.bridge.approach_before + L / 2, "Z")[0]
        sag.append(row @ statics(structure, row))
    rail = Track().rail
    bridge_EA, EI = deck.youngs_modulus * deck.area, deck.youngs_modulus * deck.second_moment
    rails_EA = 2 * rail.youngs_modulus * rail.section.area
    # deck and rails free to slide over the whole length would add EA EA_r/(EA + EA_r) h^2; the
    # rails go on beyond the deck, where they hold more
    least = 1.0 + bridge_EA * rails_EA / (bridge_EA + rails_EA) * h**2 / EI
    most = 1.0 + rails_EA * h**2 / EI + bridge_EA * h**2 / EI
    assert least < sag[1] / sag[0] < most


def test_first_frequencies_of_one_and_of_two_continuous_spans():
    found = []
    for per_deck in (1, 2):
        structure = StructureTrack(
            on_bridge(
                SOFT,
                spans=(30.0, 30.0),
                spans_per_deck=(per_deck,),
                deck=Antoing(),
                bearing_stiffness=1e15,
            )
        )
        decks = np.unique(
            np.concatenate(
                [structure.nodes.dofs(True)[deck.nodes] for deck in structure.nodes.decks]
            )
        )
        decks = decks[decks >= 0]
        K, M = (
            matrix[decks][:, decks].toarray() for matrix in (structure.stiffness, structure.mass)
        )
        omega2 = np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real)
        found.append(np.sqrt(omega2[:3]) / (2 * np.pi))
    f1 = Antoing().frequency(30.0)
    assert found[0] == pytest.approx([f1, f1, 4 * f1], rel=2e-3)
    # clamped-pinned span: tan x = tanh x, x = 3.92660
    assert found[1] == pytest.approx([f1, (3.92660231 / np.pi) ** 2 * f1, 4 * f1], rel=2e-3)


def test_the_shipped_decks():
    assert Antoing().frequency(50.0) == pytest.approx(3.205, abs=0.002)  # as published
    assert Box32m().frequency(32.0) == pytest.approx(5.112, abs=0.002)
    assert Antoing().missing == ["lateral_second_moment", "torsion_constant"]
    with pytest.raises(InputError, match=r"lateral_second_moment.*not known"):
        StructureTrack(on_bridge(deck=Antoing()), planar=False)


def test_piers_give_way_by_column_and_foundation():
    pier = Pier()
    structure = StructureTrack(on_bridge(SOFT, spans=(20.0, 20.0), piers=pier), planar=False)
    middle = structure.bridge.approach_before + 20.0
    EA = pier.youngs_modulus * pier.area
    bearing = 0.5 / structure.bridge.bearing_stiffness
    row = deck_row(structure, middle, "Z")[0]
    down = row @ statics(structure, row)
    expected = pier.height / EA + 1 / pier.vertical_stiffness + bearing
    assert down == pytest.approx(expected, rel=1e-4)  # the next deck's end hangs on it, unloaded
    # sideways at the top: the column's bending, the foundation's shift and rocking
    top = structure.nodes.piers[0].nodes[1]
    dof = structure.nodes.dofs(False)[top]
    h, EI = pier.height, pier.youngs_modulus * pier.lateral_second_moment
    alone = StructureTrack(
        on_bridge(
            SOFT,
            spans=(20.0, 20.0),
            piers=pier,
            lateral_bearing_stiffness=1.0,
            bearing_stiffness=1.0,
        ),
        planar=False,
    )
    load = np.zeros(alone.n_dofs)
    load[dof[UY]] = 1.0
    expected = h**3 / (3 * EI) + 1 / pier.horizontal_stiffness + h**2 / pier.rocking_stiffness
    assert statics(alone, load)[dof[UY]] == pytest.approx(expected, rel=1e-6)
    assert alone.nodes.dofs(True)[top, UX] == -1


@pytest.mark.parametrize("planar", [True, False])
def test_the_mirrored_track_answers_mirrored(planar):
    given = {
        "spans": (8.0, 6.0, 9.0),
        "spans_per_deck": (2, 1),
        "approach_before": 10.0,
        "approach_behind": 12.0,
        "piers": Pier(),
    }
    mirrored = given | {
        "spans": (9.0, 6.0, 8.0),
        "spans_per_deck": (1, 2),
        "approach_before": 12.0,
        "approach_behind": 10.0,
        "fixed_support": "last",
    }
    one, other = (StructureTrack(on_bridge(**g), planar=planar) for g in (given, mirrored))
    assert one.n_dofs == other.n_dofs
    for a, b in ((13.3, 17.9), (20.0, 5.1)):
        rows = [
            written_out(one.contact_rows(np.array([x]), RIGHT, "Z"), one.n_dofs)[0] for x in (a, b)
        ]
        back = [
            written_out(other.contact_rows(np.array([45.0 - x]), RIGHT, "Z"), one.n_dofs)[0]
            for x in (a, b)
        ]
        assert rows[0] @ statics(one, rows[1]) == pytest.approx(
            back[0] @ statics(other, back[1]), rel=1e-8
        )


def test_matrices_are_symmetric_banded_and_positive():
    for planar, width in ((True, 16), (False, 75)):
        structure = StructureTrack(on_bridge(spans=(32.0,) * 3, piers=Pier()), planar=planar)
        for matrix in (structure.mass, structure.damping, structure.stiffness):
            assert abs(matrix - matrix.T).max() <= 1e-12 * abs(matrix).max()
            coo = matrix.tocoo()
            assert np.abs(coo.row - coo.col).max() <= width
        assert spla.eigsh(structure.mass, 1, sigma=0, return_eigenvectors=False)[0] > 0.0


def test_whole_mass_is_that_of_all_parts():
    track = on_bridge(DiscreteSupports(layer=Slab()), spans=(20.0, 10.0), piers=Pier())
    structure = StructureTrack(track, planar=False)
    free = structure.nodes.dofs(False)
    up = np.zeros(structure.n_dofs)
    up[free[:, UZ][free[:, UZ] >= 0]] = 1.0
    bridge, pier = structure.bridge, structure.bridge.piers
    seats = sum(len(part.seats) for part in structure.nodes.stretches)
    rails = 2 * track.rail.mass_per_length * track.length
    slab = 2 * track.support.layer.mass_per_length * track.length
    sleepers = 2 * track.support.sleeper_mass * seats
    piers = pier.density * pier.area * pier.height + pier.cap_mass + pier.footing_mass
    whole = rails + slab + sleepers + 30.0 * bridge.deck.mass_per_length + piers
    # the clamped ends of the rails take a part of their first and last element with them
    assert up @ structure.mass @ up == pytest.approx(whole, rel=1e-3)


def test_a_wheel_comes_from_rigid_ground_and_goes_back_to_it():
    structure = StructureTrack(on_bridge())
    length = structure.track.length
    x = np.array([-100.0, -1e-9, 0.0, 5.0, 10.0, 200.0, length - 5.0, length + 3.0])
    np.testing.assert_allclose(structure.on_track(x), [0, 0, 0, 0.5, 1, 1, 0.5, 0], atol=1e-12)
    dofs, weights = structure.contact_rows(x, RIGHT, "Z")
    assert np.all(weights[[0, 1, 2, -1]] == 0.0)
    assert np.all((dofs >= 0) & (dofs < structure.n_dofs))


def test_supports_fit_every_span():
    bridge = Bridge(spans=(31.7, 8.0), approach_before=20.0)
    parts = stretches(bridge, 0.6)
    assert [part.deck for part in parts] == [-1, 0, 1, -1]
    assert len(parts[1].seats) == 53
    assert parts[1].seats[0] - parts[1].start == pytest.approx(parts[1].end - parts[1].seats[-1])
    assert sum(part.bays.sum() for part in parts) == pytest.approx(bridge.length)


def test_rayleigh_damping_has_its_ratio_at_two_frequencies():
    found = realised_ratio(rayleigh(0.02, 3.0, 12.0), np.array([3.0, 6.0, 12.0]))
    assert found[[0, 2]] == pytest.approx([0.02, 0.02])
    assert found[1] == pytest.approx(0.016)  # at the geometric mean 2 sqrt(w1 w2)/(w1 + w2) of it


def test_what_is_impossible_is_refused():
    with pytest.raises(InputError, match="must be one length at least"):
        Bridge(spans=())
    with pytest.raises(InputError, match=r"spans_per_deck = \[2\].*divides 3"):
        Bridge(spans=(20.0,) * 3, spans_per_deck=(2,))
    with pytest.raises(InputError, match=r"approach_before = 5.0.*entry length, 10 m"):
        Bridge(approach_before=5.0)
    with pytest.raises(InputError, match="must be discrete supports on a bridge"):
        Track(support=WinklerFoundation(), structure=Bridge())
    with pytest.raises(InputError, match=r"length = 40.0: is that of the bridge.*420 m"):
        Track(structure=Bridge(), length=40.0)
    with pytest.raises(InputError, match=r"Track.spans = 1.0: must be at least two support"):
        Track(structure=Bridge(spans=(20.0, 1.0)))
    with pytest.raises(InputError, match="stands on the ground"):
        StructureTrack(Track())
    with pytest.raises(InputError, match="stands on a bridge"):
        BeamTrack(Track(structure=Bridge()))
    track = Track(structure=Bridge(spans=("3 x 20 m", "7 m")))
    assert track.structure.spans == (20.0, 20.0, 20.0, 7.0)
    assert replace(track, rail=track.rail).length == track.length == 167.0


@pytest.mark.parametrize("layer", ["ballast", "slab"])
def test_the_track_weighs_on_a_decks_first_frequency(layer):
    """Against the whole structure's lowest frequency; its rails also stiffen it a little."""
    support = DiscreteSupports(layer=Slab() if layer == "slab" else Ballast())
    track = on_bridge(support, spans=(16.0,), approach_before=12.0, approach_behind=12.0, **STIFF)
    made, deck = StructureTrack(track), track.structure.deck
    squared = spla.eigsh(made.stiffness.tocsc(), 1, made.mass.tocsc(), sigma=0.0)[0][0]
    share = deck.mass_per_length / (deck.mass_per_length + track.mass_on_structure)
    alone = deck.frequency(16.0)
    assert np.sqrt(squared) / (2 * np.pi) == pytest.approx(alone * np.sqrt(share), rel=4e-3)
    assert share < 0.99
