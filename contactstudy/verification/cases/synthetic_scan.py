"""Made-up scans: irregularly triangulated profiles with noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh

from contactstudy.geometry.facets import rail_surface, wheel_surface
from contactstudy.profiles.curve import ProfileCurve

RADIUS = 0.46
NOISE = 2e-6
"""Standard deviation of every coordinate [m]."""
STEP = 1e-3


@dataclass(frozen=True)
class Standing:
    """How a body stands in its scan.

    Attributes
    ----------
    yaw, pitch : float
        Turn about Z, and upwards of the direction X [rad].
    at : tuple of float
        Where the origin of the profile is [m].
    """

    yaw: float = 0.0
    pitch: float = 0.0
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)


ALIGNED = Standing()


def synthetic_scan(
    profile: ProfileCurve,
    half_length: float,
    seed: int = 1,
    step: float = STEP,
    radius: float = RADIUS,
    standing: Standing = ALIGNED,
) -> trimesh.Trimesh:
    """Irregularly triangulated surface of a profile with noise, misaligned, in any order.

    Parameters
    ----------
    half_length : float
        Half its length along X [m].
    step : float
        Mean distance of the vertices [m].
    radius : float
        Of a wheel [m].

    Returns
    -------
    trimesh.Trimesh
        In m, normals out of the body.
    """
    rng = np.random.default_rng(seed)
    low, high = profile.s_range
    x = np.linspace(-half_length, half_length, round(2 * half_length / step) + 1)
    s = np.linspace(low, high, round((high - low) / step) + 1)
    grid = np.stack(np.meshgrid(x, s, indexing="ij"))
    # at most a fifth of the step, or triangles fold
    grid = grid + 0.2 * step * rng.uniform(-1.0, 1.0, grid.shape)
    s = np.clip(grid[1], low, high)
    body = rail_surface(profile, grid[0], s)
    if not profile.upper:
        body = wheel_surface(profile, radius, grid[0], s)
    turn = trimesh.transformations.euler_matrix(0.0, -standing.pitch, standing.yaw, "sxyz")
    vertices = body.vertices @ turn[:3, :3].T + np.asarray(standing.at)
    vertices = vertices + NOISE * rng.standard_normal(vertices.shape)
    return trimesh.Trimesh(vertices, rng.permutation(body.faces), process=False)
