"""Order of convergence observed over many meshes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def fitted_order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Least-squares slope of log error over log size.

    Contact points enter and leave a patch one by one: the error changes its sign with the load
    and the mesh, and three meshes alone show any order. A fit over many averages that out.

    Parameters
    ----------
    sizes, errors : sequences (n,)
        Mesh size (any unit) and size of the error, positive; errors of exactly zero are left out.
    """
    kept = [(h, e) for h, e in zip(sizes, errors, strict=True) if e > 0.0]
    h, e = np.log(np.array(kept)).T
    return float(np.polyfit(h, e, 1)[0])
