"""Cross-section of a wheel with a straight web: half mesh for a solid of revolution."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.exceptions import InputError
from contactstudy.profiles.wheel import WheelProfile
from contactstudy.solids.mapped import graded, join

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class WheelDimensions:
    """Rim, web and hub, symmetric about the wheel's mid-plane, which holds the tape circle.

    Defaults: an 860 mm monobloc wheel with straight web. Diameter 860 mm and the 135 mm rim
    are those of EN 13262/EN 13979 passenger wheels; rim, web and hub thicknesses are rounded
    values of such wheels, not a drawing, and the flange is left out: it stiffens the rim away
    from the contact only.

    Attributes
    ----------
    radius : float
        Of the tape circle in m.
    rim_width, rim_thickness : float
        In m; the rim reaches from ``radius - rim_thickness`` to the tread.
    web_thickness : float
        In m.
    hub_width, hub_radius, bore_radius : float
        In m.
    """

    radius: float = 0.430
    rim_width: float = 0.135
    rim_thickness: float = 0.060
    web_thickness: float = 0.025
    hub_width: float = 0.180
    hub_radius: float = 0.130
    bore_radius: float = 0.095

    def __post_init__(self) -> None:
        """Refuse dimensions that make no wheel."""
        problems = [
            f"wheel {name} = {value} m: must be positive"
            for name, value in vars(self).items()
            if not value > 0
        ]
        inner = self.radius - self.rim_thickness
        if not self.bore_radius < self.hub_radius < inner:
            problems.append(
                f"wheel: bore_radius ({self.bore_radius} m) < hub_radius ({self.hub_radius} m) < "
                f"radius - rim_thickness ({inner:.4g} m) is required"
            )
        if not self.web_thickness < min(self.rim_width, self.hub_width):
            problems.append(
                f"wheel web_thickness = {self.web_thickness} m: must be below the widths of rim "
                f"({self.rim_width} m) and hub ({self.hub_width} m)"
            )
        if problems:
            raise InputError(problems)


@dataclass(frozen=True)
class WheelSection:
    """Half section y >= 0 in coordinates (y, rho), rho the distance from the wheel's axis.

    Attributes
    ----------
    nodes : ndarray (n, 2)
        In m.
    quads : ndarray (m, 4)
        Corner nodes, counter-clockwise in (y, rho).
    tread : ndarray (k,)
        Nodes of the fine part of the tread, ordered by y from 0.
    bore : ndarray (b,)
        Nodes of the bore.
    """

    nodes: Array
    quads: IntArray
    tread: IntArray
    bore: IntArray

    @property
    def plane_of_symmetry(self) -> IntArray:
        """Nodes on y = 0."""
        return np.flatnonzero(np.abs(self.nodes[:, 0]) < 1e-12)


def fine_lines(half_width: float, size: float) -> Array:
    """Lines of the fine part of the tread, equal steps of `size` from 0 to `half_width` [m]."""
    return np.asarray(size * np.arange(max(2, round(half_width / size)) + 1), dtype=float)


def wheel_section_mesh(
    dimensions: WheelDimensions,
    profile: WheelProfile,
    size: float,
    contact_half_width: float,
    coarse: float = 0.012,
    growth: float = 1.6,
) -> WheelSection:
    """Mesh the half section, fine at the tread's middle.

    Parameters
    ----------
    dimensions : WheelDimensions
        Of the wheel.
    profile : WheelProfile
        Tread; must be even in y.
    size : float
        Element size at the tread in m, laterally and in depth.
    contact_half_width : float
        Lateral extent of the fine tread on each side in m.
    coarse : float
        Element size away from the tread in m.
    growth : float
        Ratio of neighbouring sizes.

    Returns
    -------
    WheelSection

    Raises
    ------
    InputError
        If the fine tread does not fit on the rim or the tread is not symmetric.
    """
    d = dimensions
    fine = fine_lines(contact_half_width, size)
    rim, web = 0.5 * d.rim_width, 0.5 * d.web_thickness
    if fine[-1] >= rim - size:
        raise InputError(
            f"wheel contact_half_width = {contact_half_width} m: must be well inside the half rim "
            f"of {rim} m"
        )
    if not np.allclose(profile.height(fine), profile.height(-fine), rtol=0, atol=1e-12):
        raise InputError(f"wheel profile '{profile.name}': a half model needs an even tread")
    # columns: fine tread, to the side of the web, to the side of the rim
    reach = graded(web - fine[-1], size, growth, coarse) if web > fine[-1] + 0.3 * size else None
    columns = fine if reach is None else np.r_[fine, fine[-1] + reach[1:]]
    n_web = int(np.argmin(np.abs(columns - web)))
    last = columns[-1] - columns[-2]
    columns = np.r_[
        columns, columns[-1] + graded(rim - columns[-1], last * growth, growth, coarse)[1:]
    ]
    # tread at rho = R - h(y); rows grow inwards
    depth = graded(d.rim_thickness, size, growth, coarse)[::-1] / d.rim_thickness
    inner = d.radius - d.rim_thickness
    outer = d.radius - np.asarray(profile.height(columns))
    rho = inner + (outer - inner)[None, :] * (1 - depth)[:, None]
    head = np.stack([np.broadcast_to(columns, rho.shape), rho], axis=2)

    stem = columns[: n_web + 1] * (web / columns[n_web])
    # the columns of the web stand straight; the rim's row above shares its nodes
    head[:, : n_web + 1, 0] = stem + (columns[: n_web + 1] - stem) * (1 - depth)[:, None]
    rows = np.linspace(
        d.hub_radius, inner, 1 + max(4, round((inner - d.hub_radius) / coarse / 1.5))
    )
    disc = np.stack(np.broadcast_arrays(stem[None, :], rows[:, None]), axis=2)
    half_hub = 0.5 * d.hub_width
    hub_columns = np.r_[stem, web + graded(half_hub - web, coarse, growth, 2 * coarse)[1:]]
    hub_rows = np.linspace(d.bore_radius, d.hub_radius, 4)
    hub = np.stack(np.broadcast_arrays(hub_columns[None, :], hub_rows[:, None]), axis=2)
    nodes, quads, ids = join(hub, disc, head)
    return WheelSection(nodes, quads, ids[2][-1, : len(fine)], ids[0][0])
