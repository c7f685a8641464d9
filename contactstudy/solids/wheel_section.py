"""Half section of a wheel, symmetric about the plane of its tape circle.

The rim and the hub are shared evenly between the two sides. The flange is left out: it stiffens
the rim away from the contact only. The whole section, with flange, is in `wheel_section_whole`.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.profiles.wheel import WheelProfile
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.mapped import graded, join


@dataclass(frozen=True)
class WheelSection:
    """Section in coordinates (y, rho), rho the distance from the wheel's axis.

    Attributes
    ----------
    nodes : ndarray (n, 2)
        In m.
    quads : ndarray (m, 4)
        Corner nodes, counter-clockwise in (y, rho).
    tread : ndarray (k,)
        Nodes of the fine part of the tread, ordered by y; in a half section from 0.
    bore : ndarray (b,)
        Nodes of the bore.
    symmetric : bool
        Half section y >= 0 of a symmetric wheel.
    """

    nodes: Array
    quads: IntArray
    tread: IntArray
    bore: IntArray
    symmetric: bool = True

    @property
    def plane_of_symmetry(self) -> IntArray:
        """Nodes on y = 0 of a half section; none of a whole one."""
        if not self.symmetric:
            return np.zeros(0, dtype=np.int64)
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
        If the fine tread does not fit on the rim, or tread or web are not symmetric.
    """
    d = dimensions
    fine = fine_lines(contact_half_width, size)
    rim, web = 0.5 * d.rim_width, 0.5 * d.web_thickness[-1]
    if any(d.web_offset):
        raise InputError(
            f"wheel web_offset = {list(d.web_offset)} m: a half model needs a web that is "
            "symmetric about the tape circle; use a whole section"
        )
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
    wide = d.web(rows)[1] / web  # the web's thickness relative to that at the rim
    disc = np.stack(np.broadcast_arrays(stem[None, :] * wide[:, None], rows[:, None]), axis=2)
    half_hub = 0.5 * d.hub_width
    foot = web * wide[0]
    hub_columns = np.r_[
        stem * wide[0], foot + graded(half_hub - foot, coarse, growth, 2 * coarse)[1:]
    ]
    hub_rows = np.linspace(d.bore_radius, d.hub_radius, 4)
    hub = np.stack(np.broadcast_arrays(hub_columns[None, :], hub_rows[:, None]), axis=2)
    nodes, quads, ids = join(hub, disc, head)
    return WheelSection(nodes, quads, ids[2][-1, : len(fine)], ids[0][0])
