"""A meshed wheel's tread over a meshed rail: contact points, candidate facets, contradictions."""

import numpy as np

from contactstudy.geometry.facets import tread_candidates
from contactstudy.geometry.interpolation import SLACK
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints, contact_points
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.geometry.search import CandidateList
from contactstudy.irregularity import TreadLines
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.track.meshed import MeshedTrack


def wheel_points(
    wheel: WheelFlexibility, quadrature: Quadrature = "gauss", geometry: Geometry | None = None
) -> ContactPoints:
    """Contact points of a wheel, the whole one, or half of one centred on an upright rail.

    Without a geometry the recipe's profiles, centred and upright.
    """
    geometry = geometry or Geometry.of(wheel.recipe)
    return contact_points(geometry, wheel.x, wheel.y, quadrature, wheel.recipe.symmetric)


def tread_lines(points: ContactPoints, geometry: Geometry) -> TreadLines:
    """The lines of contact points round a wheel: y, and how far from the touch's tangent plane."""
    # arc lengths on the profile of the points across, of the first line of points along
    first, my = slice(len(points.y)), len(points.wheel_y)
    nodes = points.wheel_y[points.wheel_rows.index[first] % my]
    s = (points.wheel_rows.weight[first] * nodes).sum(axis=1)
    touch, normal = geometry.wheel.point_and_normal(geometry.touch.wheel_s)
    c = geometry.wheel.point(s)
    return TreadLines(c[:, 0], -(c - touch) @ normal)


def candidate_list(wheel: WheelFlexibility, geometry: Geometry | None = None) -> CandidateList:
    """Search of the wheel's tread facets over the rail's running surface."""
    return tread_candidates(geometry or Geometry.of(wheel.recipe), wheel.x, wheel.y)


def mesh_problems(track: MeshedTrack, wheel: WheelFlexibility, points: ContactPoints) -> list[str]:
    """What speaks against pressing this wheel on this rail."""
    half, recipe = track.recipe.symmetric, wheel.recipe
    problems = []
    if recipe.rail_profile != track.recipe.profile:
        problems.append(
            f"surface contact: the wheel was made for rail {recipe.rail_profile}, the track "
            f"has {track.recipe.profile}"
        )
    if half != recipe.symmetric:
        kinds = {True: "half", False: "whole"}
        problems.append(
            f"surface contact: the rail is a {kinds[half]} section, the wheel a "
            f"{kinds[recipe.symmetric]} one; both must be the same"
        )
    slack = SLACK * float(np.diff(track.surface_arc).min())
    first, last = (-np.inf if half else track.surface_arc[0] - slack), track.surface_arc[-1] + slack
    if points.arc.min() < first or points.arc.max() > last:
        problems.append(
            f"wheel contact_half_width = {recipe.contact_half_width:.4g} m: its contact points "
            f"lie from {points.arc.min():.4g} to {points.arc.max():.4g} m of the rail's arc "
            "length, beyond the finely meshed running surface, "
            f"{track.surface_arc[0]:.4g} to {track.surface_arc[-1]:.4g} m"
        )
    return problems
