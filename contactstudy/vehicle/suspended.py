"""A car as a `Vehicle`: planar on one rail, planar on two, or in three dimensions."""

from dataclasses import replace
from typing import Literal

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.vehicle.bodies import PLANAR, SPATIAL, Bodies, Body, Spring, Turning
from contactstudy.vehicle.car import Car
from contactstudy.vehicle.model import Vehicle

CarModel = Literal["planar", "three_dimensional"]
"""Heave and pitch; or lateral motion, roll and yaw as well."""
_BOGIES = ("front bogie", "rear bogie")


def bogie_vehicle(car: Car) -> Vehicle:
    """Planar half of a bogie with half of the car body on top, on one rail."""
    whole = car_vehicle(car)
    names = ("car z", "front bogie z", "front bogie pitch", "wheelset 1 z", "wheelset 2 z")
    dofs = [whole.dof_names.index(name) for name in names]
    at = np.ix_(dofs, dofs)
    mass, damping, stiffness = (
        matrix[at].copy() for matrix in (whole.mass, whole.damping, whole.stiffness)
    )
    # the other bogie has the other half of the body and of its springs
    mass[0, 0] *= 0.5
    damping[0, 0] *= 0.5
    stiffness[0, 0] *= 0.5
    return Vehicle(
        mass=mass,
        damping=damping,
        stiffness=stiffness,
        wheel_dofs=np.array([3, 4]),
        wheel_offsets=np.array([0.0, -car.wheelbase]),
        static_loads=whole.static_loads[:2],
        dof_names=names,
    )


def car_vehicle(car: Car, model: CarModel = "planar", rails: int = 1) -> Vehicle:
    """Matrices of one car on one rail or on two.

    On one rail it is the half of the car over that rail. The origin of offsets is the leading
    wheelset. Dofs: car body, bogies, wheelsets from front to rear.

    Raises
    ------
    InputError
        If the car lacks lateral data that three dimensions need, or is to run on one rail there.
    """
    if model == "three_dimensional":
        if rails != 2:
            raise InputError("a car in three dimensions runs on two rails")
        if car.missing:
            missing = ", ".join(car.missing)
            raise InputError(f"lateral data are missing for three dimensions: {missing}")
    bodies = _bodies(car, model)
    mass, damping, stiffness = bodies.matrices()
    contacts = _contacts(car, bodies, model, rails)
    names, x, y, directions = (list(part) for part in zip(*contacts, strict=True))
    rows = [
        bodies.row(name, (at, side, 0.0), direction)
        for name, at, side, direction in zip(names, x, y, directions, strict=True)
    ]
    load = 0.5 * car.static_axle_load
    whole = Vehicle(
        mass=mass,
        damping=damping,
        stiffness=stiffness,
        wheel_dofs=np.zeros(0, dtype=np.int64),
        wheel_offsets=np.array(x) - max(x),
        static_loads=np.array([load if direction == "Z" else 0.0 for direction in directions]),
        dof_names=bodies.dof_names,
        contact_rows=np.array(rows),
        contact_rails=np.array([int(side > 0.0) for side in y]),
        contact_directions=tuple(directions),
    )
    if rails == 2:
        return whole
    return replace(
        whole,
        mass=0.5 * mass,
        damping=0.5 * damping,
        stiffness=0.5 * stiffness,
        wheel_dofs=np.argmax(rows, axis=1),
    )


def wheelset_positions(car: Car) -> list[float]:
    """X of the wheelsets from front to rear, from the middle between the bogies [m]."""
    pivot, half = 0.5 * car.pivot_distance, 0.5 * car.wheelbase
    return [pivot + half, pivot - half, -pivot + half, -pivot - half]


def _bodies(car: Car, model: CarModel) -> Bodies:
    spatial = model == "three_dimensional"
    dofs = SPATIAL if spatial else PLANAR
    axle = car.wheel_radius
    bogie = axle + (car.bogie_above_axle or 0.0)
    secondary = bogie + (car.secondary_above_bogie or 0.0)
    top = secondary + (car.car_above_secondary or 0.0)
    inertias = (car.car_roll_inertia, car.car_pitch_inertia, car.car_yaw_inertia)
    bodies = [Body("car", (0.0, 0.0, top), car.body_mass, _given(*inertias), dofs)]
    inertias = (car.bogie_roll_inertia, car.bogie_pitch_inertia, car.bogie_yaw_inertia)
    pivots = (0.5 * car.pivot_distance, -0.5 * car.pivot_distance)
    for name, x in zip(_BOGIES, pivots, strict=True):
        bodies.append(Body(name, (x, 0.0, bogie), car.bogie_mass, _given(*inertias), dofs))
    turning = _given(car.wheelset_roll_inertia, 0.0, car.wheelset_yaw_inertia)
    yaws = car.primary_longitudinal_stiffness is not None
    own = (("y", "z", "roll", "yaw") if yaws else ("y", "z", "roll")) if spatial else ("z",)
    springs: list[Spring] = []
    for k, x in enumerate(wheelset_positions(car)):
        name = f"wheelset {k + 1}"
        bodies.append(Body(name, (x, 0.0, axle), car.wheelset_mass, turning, own))
        springs += _pair(
            name,
            _BOGIES[k // 2],
            (x, axle),
            car.primary_spacing or 0.0,
            {
                "Z": (car.primary_vertical_stiffness, car.primary_vertical_damping),
                "Y": (car.primary_lateral_stiffness or 0.0, car.primary_lateral_damping),
                "X": (car.primary_longitudinal_stiffness or 0.0, car.primary_longitudinal_damping),
            },
        )
    for name, x in zip(_BOGIES, pivots, strict=True):
        springs += _pair(
            name,
            "car",
            (x, secondary),
            car.secondary_spacing or 0.0,
            {
                "Z": (car.secondary_vertical_stiffness, car.secondary_vertical_damping),
                "Y": (car.secondary_lateral_stiffness or 0.0, car.secondary_lateral_damping),
                "X": (car.secondary_longitudinal_stiffness, car.secondary_longitudinal_damping),
            },
        )
    bars = [Turning(name, "car", car.anti_roll_stiffness) for name in _BOGIES] if spatial else []
    return Bodies(tuple(bodies), tuple(springs), tuple(bars))


def _given(*values: float | None) -> tuple[float, float, float]:
    x, y, z = (0.0 if value is None else value for value in values)
    return x, y, z


def _pair(
    lower: str,
    upper: str,
    at: tuple[float, float],
    spacing: float,
    constants: dict[str, tuple[float, float]],
) -> list[Spring]:
    """Half of each constant on either side, at (x, z)."""
    return [
        Spring(lower, upper, (at[0], side, at[1]), direction, 0.5 * k, 0.5 * c)
        for direction, (k, c) in constants.items()
        for side in (-0.5 * spacing, 0.5 * spacing)
    ]


def _contacts(
    car: Car, bodies: Bodies, model: CarModel, rails: int
) -> list[tuple[str, float, float, str]]:
    """Wheelset, X, y and direction of each contact: wheelset by wheelset, right before left."""
    half = 0.5 * car.contact_spacing
    sides = (0.0,) if rails == 1 else (-half, half)
    directions = ("Z", "Y") if model == "three_dimensional" else ("Z",)
    return [
        (f"wheelset {k + 1}", x, side, direction)
        for k, x in enumerate(wheelset_positions(car))
        for direction in directions
        for side in sides
    ]
