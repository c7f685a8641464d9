"""The track with its rail as a beam: cubic Hermite elements, Euler-Bernoulli or Timoshenko."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Literal

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.track.discrete import AssembledTrack, pieces_at, without_held
from contactstudy.track.hermite import BeamElement
from contactstudy.track.inner_dofs import InnerDofs, pad_parts
from contactstudy.track.model import Direction, DiscreteSupports, Slab, Track, WinklerFoundation
from contactstudy.track.supports import PadRow, SupportedRail, add_supports, chain_of
from contactstudy.validation import AtLeast, Naming, Parameters, complaint

MOST_ELEMENTS = 400_000
"""Of a rail: a beam of so many takes a minute and two gigabytes to assemble."""
RailTheory = Literal["euler", "timoshenko"]


@dataclass(frozen=True)
class BeamTrack(AssembledTrack, Parameters):
    """A discretised track whose rail is a chain of equal beam elements.

    Parameters
    ----------
    element_compliance : bool
        Whether the deflection of loaded elements themselves counts, which the nodal shape
        functions leave out: `local_compliance` under the wheel, and inner dofs for what pads
        and inertia do (see `contactstudy.track.inner`). False is the paper's scheme.
    """

    track: Track
    theory: Annotated[RailTheory, "theory of the beam"] = "euler"
    elements_per_bay: Annotated[int, AtLeast(1), "beam elements between supports"] = 4
    element_compliance: Annotated[bool, "whether the loaded element's own compliance counts"] = (
        False
    )
    direction: Annotated[Direction, "vertical or lateral"] = "Z"
    _top_load: Callable[[Array], Array] | None = field(default=None, repr=False, compare=False)

    def problems(self, key: Naming) -> list[str]:
        """A track on a bridge, which `track.structure` discretises; too many elements."""
        if self.track.structure is not None:
            return [
                f"{key('track')}: stands on a bridge, which one rail alone cannot; StructureTrack"
            ]
        if self.n_elements <= MOST_ELEMENTS or self.track.n_bays > MOST_ELEMENTS:
            return []  # of a track that is too long is complained elsewhere
        allowed = (
            f"must be at most {MOST_ELEMENTS // self.track.n_bays}, {MOST_ELEMENTS} elements in "
            f"the {self.track.n_bays} bays of the track"
        )
        return [complaint(key("elements_per_bay"), self.elements_per_bay, allowed)]

    @property
    def n_elements(self) -> int:
        """Number of beam elements."""
        return self.elements_per_bay * self.track.n_bays

    @property
    def stiffest(self) -> float:
        """Stiffest contact whose vibration the elements can carry away [N/m].

        The shortest wave of elements of length h has k = pi/h, and an infinite Euler beam resists
        a force that makes waves of k with ``2 sqrt(2) EI k^3`` (L. Cremer, M. Heckl and B. A. T.
        Petersson, Structure-Borne Sound, 2005). A stiffer contact rings between wheel and element,
        and only numerical damping ends that.
        """
        length = self.track.length / self.n_elements
        return float(
            2
            * np.sqrt(2)
            * self.track.rail.bending_stiffness(self.direction)
            * (np.pi / length) ** 3
        )

    @cached_property
    def element(self) -> BeamElement:
        """The one element that the rail consists of."""
        rail, length = self.track.rail, self.track.length / self.n_elements
        bending, mass = rail.bending_stiffness(self.direction), rail.mass_per_length
        if self.theory == "euler":
            return BeamElement(length, bending, mass)
        shear, rotary = rail.shear_stiffness(self.direction), rail.rotary_inertia(self.direction)
        return BeamElement(length, bending, mass, shear, rotary)

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """See `DiscreteTrack`; k = 4 without element compliance."""
        element, xi = pieces_at(x, self.element.length, self.n_elements)
        nodal = 2 * element[:, None] + np.arange(4)
        weights = self.element.deflection_shapes(xi)
        if self._inner is not None:
            extra, values = self._inner.values(element, xi)
            extra = np.where(extra < 0, -1, 2 * self.n_elements + 2 + extra)
            nodal, weights = np.hstack((nodal, extra)), np.hstack((weights, values))
        return without_held(np.where(nodal < 0, -1, self._final_dof[nodal]), weights)

    def local_compliance(self, x: Array) -> Array:
        """Compliance at X that no dof has, (m,) [m/N]; 0 when the option is off."""
        element, xi = pieces_at(x, self.element.length, self.n_elements)
        if not self.element_compliance:
            return np.zeros_like(xi)
        compliance = self.element.clamped_compliance(xi)
        if self._inner is not None:
            compliance = np.maximum(compliance - self._inner.compliance(element, xi), 0.0)
        return compliance

    def top_load_compliance(self, x: Array) -> Array:
        """Zero, for a beam's section moves as one, unless another is given."""
        return self._top_load(x) if self._top_load else np.zeros(np.shape(x))

    def with_top_load(self, compliance: Callable[[Array], Array]) -> "BeamTrack":
        """The same beam with a `top_load_compliance`, see `track.bay`."""
        return replace(self, _top_load=compliance)

    @cached_property
    def _inner(self) -> InnerDofs | None:
        """Inner dofs of the elements, behind the nodal ones."""
        if not self.element_compliance:
            return None
        return InnerDofs.of(self.track.pad_footprints, self.element, self.n_elements)

    @property
    def n_dofs_forecast(self) -> int:
        """`n_dofs`, without assembling anything."""
        support, below = self.track.support, 0
        if isinstance(support, DiscreteSupports):
            # a half sleeper moves in one direction; a node of the slab turns as well
            below = (2 if isinstance(support.layer, Slab) else 1) * (self.track.n_bays + 1)
        return len(self._free) + below

    @cached_property
    def _free(self) -> IntArray:
        """Rail dofs (w and theta of each node in turn, inner dofs) that the ends leave free."""
        n = 2 * self.n_elements + 2
        held = {"clamped": [0, 1, n - 2, n - 1], "pinned": [0, n - 2], "free": []}
        n_inner = 0 if self._inner is None else len(self._inner.shapes)
        return np.setdiff1d(np.arange(n + n_inner), held[self.track.ends])

    @cached_property
    def _final_dof(self) -> IntArray:
        """Final dof of each rail dof, -1 where held."""
        final = np.full(self._free[-1] + 3, -1, dtype=np.int64)
        final[self._free] = self._assembled.rail_dofs
        return final

    @cached_property
    def _assembled(self) -> SupportedRail:
        element, n, inner = self.element, self.n_elements, self._inner
        mass, stiffness = chain_of(element.mass(), n), chain_of(element.stiffness(), n)
        keys = np.repeat(np.linspace(0.0, self.track.length, n + 1), 2)
        if inner is not None:
            mass = inner.with_gram(mass, element.mass_per_length, element.rotary_inertia)
            stiffness = inner.with_stiffness(stiffness)
            keys = np.concatenate((keys, (inner.elements + 0.5) * element.length))
        damping = None
        if isinstance(self.track.support, WinklerFoundation):
            bed = chain_of(element.foundation(), n)
            if inner is not None:
                bed = inner.with_gram(bed, 1.0, 0.0)
            k, c = self.track.support.values(self.direction)
            stiffness, damping = stiffness + k * bed, c * bed
        free = self._free
        return add_supports(
            mass[free][:, free],
            None if damping is None else damping[free][:, free],
            stiffness[free][:, free],
            keys[free],
            self.track,
            {self.direction: self._pad_rows()},
        )

    def _pad_rows(self) -> list[PadRow]:
        """Average deflection over each pad, by exact integration of the shape functions."""
        n_nodal, free = 2 * self.n_elements + 2, self._free
        rows = []
        row = np.zeros(free[-1] + 3)
        for pad, footprint in enumerate(self.track.pad_footprints):
            touched = []
            length, total = self.element.length, footprint[1] - footprint[0]
            for e, begin, end in pad_parts(footprint, length, self.n_elements):
                nodal = np.arange(2 * e, 2 * e + 4)
                if end > begin:
                    row[nodal] += self.element.average_shapes(begin / length, end / length) / total
                else:
                    row[nodal] += self.element.deflection_shapes(np.array(begin / length))
                touched.append(nodal)
            if self._inner is not None:
                dofs, weights = self._inner.pad_weights(pad)
                np.add.at(row, n_nodal + dofs, weights)
                touched.append(n_nodal + dofs)
            at = np.unique(np.concatenate(touched))
            place = np.searchsorted(free, at)
            held = free[np.minimum(place, len(free) - 1)] != at
            used = ~held & (row[at] != 0.0)
            rows.append(PadRow(place[used], row[at[used]]))
            row[at] = 0.0
        return rows
