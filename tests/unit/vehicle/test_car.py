"""One car against closed forms, statics, symmetry, and energies written down by hand."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import eigh

from contactstudy.exceptions import InputError
from contactstudy.vehicle.bodies import Body
from contactstudy.vehicle.car import Car
from contactstudy.vehicle.suspended import bogie_vehicle, car_vehicle, wheelset_positions
from contactstudy.vehicle.vehicle_file import read_car, shipped_cars

G = 9.81
# every value another, so that none can stand for another
FULL = Car(
    length=25.0,
    pivot_distance=17.0,
    wheelbase=2.6,
    car_mass=40e3,
    car_pitch_inertia=2.0e6,
    bogie_mass=3000.0,
    bogie_pitch_inertia=3900.0,
    wheelset_mass=1800.0,
    primary_vertical_stiffness=1.2e6,
    primary_vertical_damping=39e3,
    secondary_vertical_stiffness=0.5e6,
    secondary_vertical_damping=90e3,
    wheel_radius=0.45,
    contact_spacing=1.49,
    car_roll_inertia=0.9e5,
    car_yaw_inertia=2.1e6,
    bogie_roll_inertia=1900.0,
    bogie_yaw_inertia=3100.0,
    wheelset_roll_inertia=900.0,
    wheelset_yaw_inertia=950.0,
    primary_lateral_stiffness=5e6,
    primary_lateral_damping=1e3,
    primary_longitudinal_stiffness=9e6,
    primary_longitudinal_damping=2e3,
    secondary_lateral_stiffness=0.4e6,
    secondary_lateral_damping=50e3,
    secondary_longitudinal_stiffness=0.3e6,
    secondary_longitudinal_damping=60e3,
    anti_roll_stiffness=0.7e6,
    primary_spacing=2.0,
    secondary_spacing=1.9,
    car_above_secondary=0.8,
    secondary_above_bogie=0.3,
    bogie_above_axle=0.14,
)


def energies(car, u):
    """Twice the kinetic (of velocities u) and the potential energy, written down body by body."""
    names = [("c", d) for d in ("y", "z", "rx", "ry", "rz")]
    names += [(b, d) for b in "FR" for d in ("y", "z", "rx", "ry", "rz")]
    names += [(w, d) for w in "1234" for d in ("y", "z", "rx", "rz")]
    q = dict(zip(names, u, strict=True))
    T = V = 0.0
    masses = [("c", car.car_mass, car.car_roll_inertia, car.car_pitch_inertia, car.car_yaw_inertia)]
    masses += [
        (b, car.bogie_mass, car.bogie_roll_inertia, car.bogie_pitch_inertia, car.bogie_yaw_inertia)
        for b in "FR"
    ]
    masses += [
        (w, car.wheelset_mass, car.wheelset_roll_inertia, 0, car.wheelset_yaw_inertia)
        for w in "1234"
    ]
    for name, m, jx, jy, jz in masses:
        T += m * (q[name, "y"] ** 2 + q[name, "z"] ** 2) / 2
        T += jx * q[name, "rx"] ** 2 / 2 + jz * q[name, "rz"] ** 2 / 2
        T += jy * q[name, "ry"] ** 2 / 2 if jy else 0
    half_b, half_s = car.primary_spacing / 2, car.secondary_spacing / 2
    for b, at, wheels in (("F", 1, "12"), ("R", -1, "34")):
        lc = at * car.pivot_distance / 2
        for side in (-1, 1):
            y = side * half_s
            # car's underside against the bogie's top, H_cb and H_bt of the field
            up = q["c", "z"] + y * q["c", "rx"] - lc * q["c", "ry"]
            up -= q[b, "z"] + y * q[b, "rx"]
            across = q["c", "y"] + lc * q["c", "rz"] + car.car_above_secondary * q["c", "rx"]
            across -= q[b, "y"] - car.secondary_above_bogie * q[b, "rx"]
            along = -y * (q["c", "rz"] - q[b, "rz"])
            V += car.secondary_vertical_stiffness / 2 * up**2 / 2
            V += car.secondary_lateral_stiffness / 2 * across**2 / 2
            V += car.secondary_longitudinal_stiffness / 2 * along**2 / 2
        V += car.anti_roll_stiffness * (q["c", "rx"] - q[b, "rx"]) ** 2 / 2
        for w, end in zip(wheels, (1, -1), strict=True):
            lt = end * car.wheelbase / 2
            for side in (-1, 1):
                y = side * half_b
                up = q[b, "z"] + y * q[b, "rx"] - lt * q[b, "ry"] - q[w, "z"] - y * q[w, "rx"]
                across = q[b, "y"] + lt * q[b, "rz"] + car.bogie_above_axle * q[b, "rx"]
                across -= q[w, "y"]
                along = -y * (q[b, "rz"] - q[w, "rz"])
                V += car.primary_vertical_stiffness / 2 * up**2 / 2
                V += car.primary_lateral_stiffness / 2 * across**2 / 2
                V += car.primary_longitudinal_stiffness / 2 * along**2 / 2
    return 2 * T, 2 * V


def hessians(car, n):
    """Matrices of the quadratic energies: 2 E(a + b) - 2 E(a) - 2 E(b) = 2 a^T M b."""
    eye = np.eye(n)
    own = np.array([energies(car, e) for e in eye])
    found = np.zeros((2, n, n))
    for i in range(n):
        for j in range(n):
            both = np.array(energies(car, eye[i] + eye[j]))
            found[:, i, j] = 0.5 * (both - own[i] - own[j])
    return found


def test_matrices_in_three_dimensions_are_those_of_the_energies():
    made = car_vehicle(FULL, "three_dimensional", 2)
    assert made.n_dofs == 31
    mass, stiffness = hessians(FULL, 31)
    np.testing.assert_allclose(made.mass, mass, rtol=1e-12)
    scale = np.abs(stiffness).max()
    np.testing.assert_allclose(made.stiffness, stiffness, rtol=1e-12, atol=1e-13 * scale)


def test_damping_has_the_form_of_stiffness():
    swapped = {
        f"{stage}_{way}_stiffness": getattr(FULL, f"{stage}_{way}_damping")
        for stage in ("primary", "secondary")
        for way in ("vertical", "lateral", "longitudinal")
    }
    other = dataclasses.replace(FULL, **swapped, anti_roll_stiffness=0.0)
    damping = car_vehicle(FULL, "three_dimensional", 2).damping
    as_stiffness = car_vehicle(other, "three_dimensional", 2).stiffness
    np.testing.assert_allclose(damping, as_stiffness, rtol=1e-12)


@pytest.mark.parametrize("name", ["s300", "ice3", "manchester", "china_star"])
def test_frequencies_on_held_wheels_are_those_of_closed_forms(name):
    car = read_car(name)
    planar = car_vehicle(car)
    free = [k for k, dof in enumerate(planar.dof_names) if not dof.startswith("wheelset")]
    at = np.ix_(free, free)
    found = np.sort(np.sqrt(eigh(planar.stiffness[at], planar.mass[at], eigvals_only=True)))
    k1, k2 = car.primary_vertical_stiffness, car.secondary_vertical_stiffness
    lc, lt = car.pivot_distance / 2, car.wheelbase / 2
    # heave and pitch of the body with both bogies in or against phase; pitch of the bogies alone
    expected = [np.sqrt(2 * k1 * lt**2 / car.bogie_pitch_inertia)] * 2
    for m, k in ((car.body_mass, 2 * k2), (car.car_pitch_inertia, 2 * k2 * lc**2)):
        arm = k / (2 * k2)  # 1 or lc^2
        M = np.diag([m, 2 * car.bogie_mass])
        K = np.array([[k, -k / np.sqrt(arm)], [-k / np.sqrt(arm), 2 * k2 + 4 * k1]])
        expected += list(np.sqrt(eigh(K, M, eigvals_only=True)))
    np.testing.assert_allclose(found, np.sort(expected), rtol=1e-9)


def test_heave_of_a_body_on_stiff_primary_springs():
    car = dataclasses.replace(FULL, primary_vertical_stiffness=1e15)
    planar = car_vehicle(car)
    free = [k for k, dof in enumerate(planar.dof_names) if not dof.startswith("wheelset")]
    at = np.ix_(free, free)
    lowest = np.sqrt(eigh(planar.stiffness[at], planar.mass[at], eigvals_only=True)[:2])
    heave = np.sqrt(2 * car.secondary_vertical_stiffness / car.car_mass)
    pitch = np.sqrt(
        2 * car.secondary_vertical_stiffness * (car.pivot_distance / 2) ** 2 / car.car_pitch_inertia
    )
    np.testing.assert_allclose(np.sort(lowest), np.sort([heave, pitch]), rtol=1e-5)


@pytest.mark.parametrize("model, rails", [("planar", 1), ("planar", 2), ("three_dimensional", 2)])
def test_static_loads_carry_the_weight(model, rails):
    made = car_vehicle(FULL, model, rails)
    weight = (FULL.car_mass + 2 * FULL.bogie_mass + 4 * FULL.wheelset_mass) * G
    assert made.static_loads.sum() == pytest.approx(weight * rails / 2, rel=1e-12)
    # and have its resultant in the middle between the bogies
    masses = np.diag(made.mass)
    gravity = np.array(
        [-G * m if n.endswith(" z") else 0.0 for n, m in zip(made.dof_names, masses, strict=True)]
    )
    left = gravity + made.static_loads @ made.contact_rows
    bounce = np.array([1.0 if n.endswith(" z") else 0.0 for n in made.dof_names])
    assert abs(left @ bounce) < 1e-6
    x = made.contact_offsets[:, None] - np.mean(made.contact_offsets)
    assert abs(float(made.static_loads @ x[:, 0])) < 1e-6 * weight


def test_rigid_motions_cost_no_energy():
    made = car_vehicle(FULL, "three_dimensional", 2)
    heights = {"car": 0.45 + 0.14 + 0.3 + 0.8, "bogie": 0.45 + 0.14, "wheelset": 0.45}
    x = {"car": 0.0, "front bogie": 8.5, "rear bogie": -8.5}
    x |= {f"wheelset {k + 1}": at for k, at in enumerate(wheelset_positions(FULL))}

    def motion(y, z, roll, pitch, yaw):
        u = []
        for name in made.dof_names:
            body, dof = name.rsplit(" ", 1)
            h = next(v for k, v in heights.items() if k in body)
            u.append(
                {"y": y + yaw * x[body] - roll * h, "z": z - pitch * x[body],
                 "roll": roll, "pitch": pitch, "yaw": yaw}[dof]
            )  # fmt: skip
        return np.array(u)

    for k in range(5):
        u = motion(*np.eye(5)[k])
        force = made.stiffness @ u
        assert np.abs(force).max() < 1e-9 * np.abs(made.stiffness).max(), k
    # beside them a bogie may pitch with its wheelsets: nothing else is free
    nullity = made.n_dofs - np.linalg.matrix_rank(made.stiffness, tol=1e-3)
    assert nullity == 5 + 2


def test_contacts_follow_roll_and_heave():
    made = car_vehicle(FULL, "three_dimensional", 2)
    assert made.n_contacts == 16 and made.n_wheels == 8
    np.testing.assert_array_equal(made.contact_rails, [0, 1] * 8)
    assert made.contact_directions == ("Z", "Z", "Y", "Y") * 4
    u = np.zeros(31)
    u[made.dof_names.index("wheelset 2 roll")] = 1e-3
    u[made.dof_names.index("wheelset 2 y")] = 2e-3
    moved = made.contact_rows @ u
    # left side up, treads (0.45 m below the axle) to the left
    expected = np.zeros(16)
    expected[4:8] = [-0.745e-3, 0.745e-3, 2e-3 + 0.45e-3, 2e-3 + 0.45e-3]
    np.testing.assert_allclose(moved, expected, atol=1e-15)


def test_a_mirrored_car_has_mirrored_matrices():
    made = car_vehicle(FULL, "three_dimensional", 2)
    # y -> -y turns roll and yaw round and swaps the rails
    sign = np.array([-1.0 if n.rsplit(" ", 1)[1] in ("y", "roll", "yaw") else 1.0 for n in
                     made.dof_names])  # fmt: skip
    for matrix in (made.mass, made.damping, made.stiffness):
        np.testing.assert_allclose(sign[:, None] * matrix * sign, matrix, atol=1e-6)
    swapped = made.contact_rows.reshape(8, 2, 31)[:, ::-1].reshape(16, 31)
    across = np.array([-1.0 if d == "Y" else 1.0 for d in made.contact_directions])
    np.testing.assert_allclose(across[:, None] * swapped * sign, made.contact_rows, atol=1e-15)
    # x -> -x: front and rear change places, pitch and yaw turn round
    names = list(made.dof_names)
    swap = {"front bogie": "rear bogie", "rear bogie": "front bogie", "car": "car"}
    swap |= {f"wheelset {k}": f"wheelset {5 - k}" for k in range(1, 5)}
    order = [names.index(f"{swap[n.rsplit(' ', 1)[0]]} {n.rsplit(' ', 1)[1]}") for n in names]
    turned = np.array([-1.0 if n.endswith(("pitch", "yaw")) else 1.0 for n in names])
    mirrored = turned[:, None] * made.stiffness[np.ix_(order, order)] * turned
    np.testing.assert_allclose(mirrored, made.stiffness, atol=1e-6)


def test_planar_models_agree_with_each_other():
    one, two = car_vehicle(FULL), car_vehicle(FULL, "planar", 2)
    np.testing.assert_allclose(2 * one.stiffness, two.stiffness)
    np.testing.assert_allclose(2 * one.mass, two.mass)
    assert one.planar and not two.planar
    three = car_vehicle(FULL, "three_dimensional", 2)
    at = [three.dof_names.index(name) for name in one.dof_names]
    np.testing.assert_allclose(three.stiffness[np.ix_(at, at)], two.stiffness, atol=1e-6)
    np.testing.assert_allclose(one.wheel_offsets, [0.0, -2.6, -17.0, -19.6])


def test_a_bogie_bounces_as_half_the_car():
    bogie, car = bogie_vehicle(FULL), car_vehicle(FULL)
    assert bogie.static_loads.sum() == pytest.approx(0.5 * car.static_loads.sum())
    assert np.trace(bogie.mass[[0, 1, 3, 4]][:, [0, 1, 3, 4]]) * G == pytest.approx(
        bogie.static_loads.sum()
    )
    for matrix in (bogie.stiffness, bogie.damping):
        np.testing.assert_allclose(matrix @ np.array([1.0, 1.0, 0.0, 1.0, 1.0]), 0.0, atol=1e-6)
    # with both bogies in phase the whole car has the bogie's frequencies
    in_phase = np.zeros((10, 5))
    for k, names in enumerate((["car z"], ["front bogie z", "rear bogie z"], [], ["wheelset 1 z",
                               "wheelset 3 z"], ["wheelset 2 z", "wheelset 4 z"])):  # fmt: skip
        in_phase[[car.dof_names.index(n) for n in names], k] = 1.0
    in_phase[car.dof_names.index("front bogie pitch"), 2] = 1.0
    in_phase[car.dof_names.index("rear bogie pitch"), 2] = 1.0
    np.testing.assert_allclose(
        in_phase.T @ car.stiffness @ in_phase, 2 * bogie.stiffness, atol=1e-6
    )


def test_without_stiffness_along_the_track_wheelsets_do_not_yaw():
    made = car_vehicle(read_car("high_speed_motor"), "three_dimensional", 2)
    assert made.n_dofs == 27 and "wheelset 1 yaw" not in made.dof_names


@pytest.mark.parametrize(
    "name, tonnes, planar_only",
    [
        ("s300", 13.7, True),
        ("ice3_end", 15.5, True),
        ("manchester", 11.1, True),
        ("china_star", 19.5, True),
        ("high_speed_motor", 16.0, False),
        ("high_speed_trailer", 14.6, False),
    ],
)
def test_shipped_cars_have_their_published_axle_loads(name, tonnes, planar_only):
    car = read_car(name)
    assert car.static_axle_load / G / 1e3 == pytest.approx(tonnes, abs=0.06)
    assert bool(car.missing) == planar_only
    if planar_only:
        with pytest.raises(InputError, match="lateral data are missing"):
            car_vehicle(car, "three_dimensional", 2)


def test_every_shipped_car_names_its_source():
    for name, path in shipped_cars().items():
        assert "source =" in path.read_text("utf-8"), name
        made = car_vehicle(read_car(name))
        assert np.linalg.matrix_rank(made.stiffness, tol=1.0) == 6  # of 10: one a spring


def test_axle_load_in_place_of_the_mass_of_the_body():
    values = {f.name: getattr(FULL, f.name) for f in dataclasses.fields(FULL)}
    whole = 40e3 + 2 * 3000.0 + 4 * 1800.0
    for load in ("13.3 t", "13300 kg", 13.3e3 * G, f"{13.3 * G} kN"):
        car = Car(**values | {"car_mass": None, "axle_load": load})
        assert car.body_mass == pytest.approx(4 * 13.3e3 - whole + 40e3, rel=1e-12)
        assert car.static_axle_load == pytest.approx(13.3e3 * G)


@pytest.mark.parametrize(
    "change, message",
    [
        ({"axle_load": "10 t"}, "give either this or"),
        ({"car_mass": None}, "give either this or"),
        ({"car_mass": "400 kN"}, "has the wrong unit 'kN'; allowed: kg"),
        ({"car_mass": None, "axle_load": "3 t"}, "the weight of bogies and wheelsets"),
        ({"wheelbase": 17.0}, "must be below Car.pivot_distance, 17 m"),
        ({"length": 19.0}, "stick out of the car by 0.3 m"),
        ({"pivot_offset": 3.0}, "stick out of the car by 0.3 m"),
        ({"bogie_mass": 0.0}, "must be above 0 kg"),
    ],
)
def test_impossible_cars(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(FULL, **change)


def test_a_spring_between_two_points_stretches_by_their_distance():
    body = Body("b", (1.0, 0.0, 2.0), 3.0, (4.0, 5.0, 6.0), ("y", "z", "roll", "pitch", "yaw"))
    angles, r = np.array([1e-3, 2e-3, -3e-3]), np.array([1.5, -0.7, 2.4])
    shift = np.array([0.0, 0.01, -0.02])
    exact = shift + np.cross(angles, r - np.array([1.0, 0.0, 2.0]))
    u = np.r_[shift[1:], angles]
    assert body.row(r, "Y") @ u == pytest.approx(exact[1])
    assert body.row(r, "Z") @ u == pytest.approx(exact[2])
