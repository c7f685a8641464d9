"""Pieces of a profile curve by their own arc length: line, circular arc, parametric curve.

Every piece is walked from its start, t = 0, to its end, t = length, and answers with its points,
unit tangents and the rate at which the tangent turns to the left (signed curvature).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

from contactstudy.arrays import Array

if TYPE_CHECKING:
    from scipy.interpolate import BSpline, CubicHermiteSpline

Frame = tuple[Array, Array, Array]


class Piece(Protocol):
    """Part of a plane curve by arc length."""

    @property
    def length(self) -> float:
        """Arc length [m]."""

    def frame(self, t: Array) -> Frame:
        """Points (n, 2) [m], unit tangents (n, 2), left curvature (n,) [1/m] at arc lengths t."""


@dataclass(frozen=True)
class LinePiece:
    """Straight piece between end points (y, z) in walking order [m]."""

    start: tuple[float, float]
    end: tuple[float, float]

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return math.dist(self.start, self.end)

    @property
    def mirrored(self) -> LinePiece:
        """Mirror image about y = 0, walked towards growing y as well."""
        return LinePiece(_image(self.end), _image(self.start))

    def frame(self, t: Array) -> Frame:
        """Points, unit tangents and curvature at arc lengths t (n,)."""
        start = np.asarray(self.start)
        tangent = (np.asarray(self.end) - start) / self.length
        return start + t[:, None] * tangent, np.tile(tangent, (len(t), 1)), np.zeros(len(t))


@dataclass(frozen=True)
class ArcPiece:
    """Circular piece, shorter than half a circle; centre, start and end (y, z) [m]."""

    centre: tuple[float, float]
    start: tuple[float, float]
    end: tuple[float, float]

    @cached_property
    def _circle(self) -> tuple[float, float, float]:
        """Radius, angle of the start, signed sweep."""
        a, b = (
            math.atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end)
        )
        sweep = (b - a + math.pi) % (2.0 * math.pi) - math.pi
        return math.dist(self.centre, self.start), a, sweep

    @property
    def length(self) -> float:
        """Arc length [m]."""
        radius, _, sweep = self._circle
        return radius * abs(sweep)

    @property
    def mirrored(self) -> ArcPiece:
        """Mirror image about y = 0, walked towards growing y as well."""
        return ArcPiece(_image(self.centre), _image(self.end), _image(self.start))

    def frame(self, t: Array) -> Frame:
        """Points, unit tangents and curvature at arc lengths t (n,)."""
        radius, begin, sweep = self._circle
        turn = math.copysign(1.0, sweep)
        turned = turn * t / radius
        # c(t) - c(0) = R [ (cos a - 1) e - turn sin a ... ]: chord form, so that points near the
        # start keep all digits however large the radius: |chord| = 2 R sin(a/2)
        chord = 2.0 * radius * np.sin(0.5 * np.abs(turned))
        chord_angle = begin + 0.5 * turned + turn * 0.5 * math.pi
        points = np.asarray(self.start) + np.stack(
            [chord * np.cos(chord_angle), chord * np.sin(chord_angle)], axis=-1
        )
        angle = begin + turned + turn * 0.5 * math.pi
        tangents = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return points, tangents, np.full(len(t), turn / radius)


def _image(point: tuple[float, float]) -> tuple[float, float]:
    return -point[0], point[1]


class Path(Protocol):
    """Curve c(u) with its first two derivatives."""

    def derivatives(self, u: Array) -> tuple[Array, Array, Array]:
        """c, c', c'' at u (n,), each (n, 2)."""


@dataclass(frozen=True)
class PolynomialPath:
    """Graph of a polynomial, ``z = unit * sum_k c_k (y/unit)^k`` with u = y; the unit in m."""

    coefficients: tuple[float, ...]
    unit: float = 1e-3

    def height(self, y: Array, derivative: int = 0) -> Array:
        """z and its derivatives with y [m, 1, 1/m]."""
        # Horner's scheme
        terms, x = self._derivatives[derivative], y / self.unit
        value = np.full_like(x, terms[-1])
        for term in terms[-2::-1]:
            value = term + value * x
        return self.unit ** (1 - derivative) * value

    @cached_property
    def _derivatives(self) -> list[list[float]]:
        """Coefficients of the polynomial, its first and its second derivative."""
        polynomial = np.polynomial.Polynomial(self.coefficients)
        return [polynomial.deriv(k).coef.tolist() for k in range(3)]

    def derivatives(self, u: Array) -> tuple[Array, Array, Array]:
        """c, c', c'' at u (n,), each (n, 2)."""
        one, zero = np.ones_like(u), np.zeros_like(u)
        return (
            np.stack([u, self.height(u)], axis=-1),
            np.stack([one, self.height(u, 1)], axis=-1),
            np.stack([zero, self.height(u, 2)], axis=-1),
        )


@dataclass(frozen=True)
class SplinePath:
    """Plane spline of a parameter u with values (y, z) [m], twice continuously differentiable."""

    spline: BSpline

    def derivatives(self, u: Array) -> tuple[Array, Array, Array]:
        """c, c', c'' at u (n,), each (n, 2)."""
        return self.spline(u), self.spline(u, 1), self.spline(u, 2)


# Gauss-Legendre rule of one panel of the arc length
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class ParametricPiece:
    """Piece of a curve c(u) for u from `begin` to `end` > `begin`.

    Points, tangents and curvature are those of c exactly; only the arc length at which they are
    found is interpolated, in a table u(t) of `panels` (error below 1e-12 m for panels well below
    the radius of curvature).
    """

    path: Path
    begin: float
    end: float
    panels: int = 400

    @cached_property
    def _parameter(self) -> CubicHermiteSpline:
        """U as a function of the arc length t: du/dt = 1/|c'|."""
        from scipy.interpolate import CubicHermiteSpline

        u = np.linspace(self.begin, self.end, self.panels + 1)
        half = 0.5 * np.diff(u)
        inner = (u[:-1] + half)[:, None] + half[:, None] * _NODES
        speed = self._speed(inner.ravel()).reshape(inner.shape)
        t = np.concatenate([[0.0], np.cumsum(half * (speed @ _WEIGHTS))])
        return CubicHermiteSpline(t, u, 1.0 / self._speed(u))

    def _speed(self, u: Array) -> Array:
        return np.asarray(np.linalg.norm(self.path.derivatives(u)[1], axis=-1))

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return float(self._parameter.x[-1])

    def frame(self, t: Array) -> Frame:
        """Points, unit tangents and curvature at arc lengths t (n,)."""
        u = np.clip(self._parameter(t), self.begin, self.end)
        c, d, dd = self.path.derivatives(u)
        speed = np.linalg.norm(d, axis=-1)
        # k = (y' z'' - z' y'') / |c'|^3
        k = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / speed**3
        return c, d / speed[:, None], k
