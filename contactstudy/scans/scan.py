"""A scanned rail head or wheel tread: its facets, and the smooth shape fitted to them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.outliers import LARGEST_RESIDUAL
from contactstudy.profiles.scan_fit import STEEPEST, ScanFit
from contactstudy.profiles.scanned_rail import RAIL_DEPTH, fit_rail_head
from contactstudy.profiles.scanned_wheel import WHEEL_DEPTH, fit_wheel_tread
from contactstudy.profiles.scatter import doubted, scatter_of_rounding
from contactstudy.profiles.worn import Body
from contactstudy.scans.faults import triangles
from contactstudy.scans.reading import OWN3, UNITS, Ways3, read_mesh

if TYPE_CHECKING:
    import trimesh

_NEAR = 10.0  # residual limits within which a facet belongs to the fitted surface


@dataclass(frozen=True, eq=False)
class Scan:
    """A scan in the fitted surface's own axes.

    Attributes
    ----------
    name : str
        Of the file.
    body : {"rail", "wheel"}
    mesh : trimesh.Trimesh
        All facets [m]; the origin is the rail's crown in the middle of the scan, or the lowest
        point of the tape circle; Y to the field side, Z up.
    fit : ScanFit
        The smooth surface.
    """

    name: str
    body: Body
    mesh: trimesh.Trimesh
    fit: ScanFit
    #: What its scatter leaves in doubt, "" for nothing.
    doubt: str = ""

    @property
    def curve(self) -> ProfileCurve:
        """The fitted generating curve."""
        return self.fit.curve

    def summary(self) -> str:
        """One line with what was fitted and how well."""
        fit = self.fit
        angles = ", ".join(f"{name} {1e3 * angle:.3g} mrad" for name, angle in fit.angles.items())
        radius = "" if self.body == "rail" else f", radius {fit.radius:.6g} m"
        return (
            f"{self.name}: {fit.points} points, residual {1e6 * fit.rms:.3g} um rms, "
            f"{1e6 * fit.largest:.3g} um at most (scatter {1e6 * fit.scatter:.3g} um), "
            f"{fit.knots} knots, {angles}{radius}"
        )


def read_scan(
    path: str | Path,
    unit: str,
    body: Body,
    origin: float = 0.0,
    smoothing: float = 1e-3,
    residual_limit: float = LARGEST_RESIDUAL,
    ways: Ways3 = OWN3,
) -> Scan:
    """Read a scan and fit the smooth surface.

    Parameters
    ----------
    path, unit, body
        As in `contactstudy.scans.reading.read_mesh`.
    origin : float
        Y in the scan of the rail's middle plane (half way along the scan) or of the wheel's tape
        circle (where it is lowest) [m].
    smoothing, residual_limit : float
        Least distance of the fitted curve's knots, and largest allowed root mean square of the
        residual [m].
    ways : tuple of str
        Where the file's x, y and z point, see `contactstudy.scans.reading.read_mesh`.

    Raises
    ------
    InputError
        As `read_mesh`; if the surface is not prismatic (rail) or of revolution (wheel) within
        the limit; if facets of it face into the body.
    """
    import trimesh

    name = Path(path).name
    mesh = read_mesh(path, unit, body, ways, origin)
    fit_body = fit_rail_head if body == "rail" else fit_wheel_tread
    points, normals = np.asarray(mesh.vertices), np.asarray(mesh.vertex_normals)
    used = np.zeros(len(points), dtype=bool)
    used[mesh.faces] = True
    fit = fit_body(points[used], normals[used], origin, smoothing, name)
    problems = []
    if fit.rms > residual_limit:
        shape = "prismatic" if body == "rail" else "a surface of revolution"
        problems.append(
            f"{path}: not {shape} within {1e6 * residual_limit:.4g} um: the residual of the fit is "
            f"{1e6 * fit.rms:.4g} um rms, {1e6 * fit.largest:.4g} um at most, of which "
            f"{1e6 * fit.scatter:.4g} um is scatter from point to point; scan a shorter or cleaner "
            "piece, or raise the limit"
        )
    rounding = scatter_of_rounding(points, points / UNITS[unit])
    try:
        doubt = doubted(fit.curve, max(fit.scatter, rounding), fit.points, (smoothing,))
    except InputError as error:
        # who raises the limit of the residual has seen it
        problems += error.problems if residual_limit <= LARGEST_RESIDUAL else ()
        doubt = error.problems[0]
    scan = Scan(
        name,
        body,
        trimesh.Trimesh(fit.aligned(mesh.vertices), mesh.faces, process=False),
        fit,
        doubt,
    )
    flipped = _facing_inwards(scan, residual_limit)
    if len(flipped):
        problems.append(
            f"{path}: {triangles(len(flipped), 'flipped')} on the running surface, not joined to "
            "their neighbours, whose normals point into the body (the first: "
            f"{', '.join(str(k) for k in flipped[:3])})"
        )
    if problems:
        raise InputError(problems)
    return scan


def developed(scan: Scan, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places on the fitted surface of points (n, 3) in its own axes, each (n,) [m].

    Along the rail, or along the wheel's tape circle from its lowest point; arc length on the
    generating curve; distance outwards from the surface.
    """
    if scan.body == "rail":
        s, distance = scan.curve.project(points[:, 1:])
        return points[:, 0], s, distance
    radius = scan.fit.radius
    up = radius - points[:, 2]
    rho = np.hypot(points[:, 0], up)
    s, distance = scan.curve.project(np.stack([points[:, 1], radius - rho], axis=-1))
    return radius * np.arctan2(points[:, 0], up), s, distance


def _facing_inwards(scan: Scan, limit: float) -> np.ndarray:
    """Facets that lie on the fitted surface with their backs outwards."""
    mesh = scan.mesh
    centres, normals = np.asarray(mesh.triangles_center), np.asarray(mesh.face_normals)
    if scan.body == "rail":
        suspect = (normals[:, 2] < -np.cos(STEEPEST)) & (centres[:, 2] > -RAIL_DEPTH)
    else:
        out = centres - np.array([0.0, 0.0, scan.fit.radius])
        rho = np.hypot(out[:, 0], out[:, 2])
        radial = (normals[:, 0] * out[:, 0] + normals[:, 2] * out[:, 2]) / rho
        suspect = (radial < -np.cos(STEEPEST)) & (rho > scan.fit.radius - WHEEL_DEPTH)
    which = np.flatnonzero(suspect)
    if not len(which):
        return which
    _, s, distance = developed(scan, centres[which])
    low, high = scan.curve.s_range
    return which[(np.abs(distance) < _NEAR * limit) & (s > low) & (s < high)]
