"""The discretisation error of surface contact itself: what is stated of it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ReferenceError:
    """What meshes, modes, penalty and time step leave in the contact force, relative L2.

    Attributes
    ----------
    force, dynamic : float
        Of the total force and of its dynamic part.
    """

    force: float
    dynamic: float


DEFAULTS = ReferenceError(force=0.0013, dynamic=0.0047)
"""At the defaults, on the default case; ``contactstudy verify convergence`` computes both too."""
