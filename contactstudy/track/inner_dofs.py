"""The inner dofs of a beam rail: which elements have which shapes, and their matrices."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.track.hermite import BeamElement
from contactstudy.track.inner import InnerShape, average, gram, gram_with_nodes

NO_PAD = -1
# a pad that covers more of an element makes the element's own shape superfluous
_WHOLE = 0.95


def pad_parts(
    footprint: Array, element_length: float, n_elements: int
) -> Iterator[tuple[int, float, float]]:
    """Elements under a footprint (first and last X), and the part covered from the left node on.

    A footprint of no length gives one part of no length.
    """
    first, last = footprint / element_length
    tiny = 1e-9
    start = min(int(first + tiny), n_elements - 1)
    stop = max(start, min(int(np.ceil(last - tiny)) - 1, n_elements - 1))
    for e in range(start, stop + 1):
        begin = max(float(first) - e, 0.0) * element_length
        end = min(float(last) - e, 1.0) * element_length
        yield e, round(begin, 12), round(end, 12)


@dataclass(frozen=True)
class InnerDofs:
    """One dof for each element (its own inertia) and for each element under each pad.

    A dof is scaled so that the average of its shape over its own force's footprint is 1.

    Parameters
    ----------
    elements, pads : ndarray
        (nb,) element and pad (or `NO_PAD`) of each dof.
    """

    elements: IntArray
    pads: IntArray
    shapes: tuple[InnerShape, ...]
    n_elements: int

    @classmethod
    def of(cls, footprints: Array, element: BeamElement, n_elements: int) -> "InnerDofs":
        """Dofs for n_elements equal elements with pads, (n_pads, 2) first and last X."""
        whole = round(element.length, 12)
        found: list[tuple[int, int, InnerShape]] = []
        covered = set()
        for pad, footprint in enumerate(footprints):
            length = round(float(footprint[1] - footprint[0]), 12)
            for e, begin, end in pad_parts(footprint, element.length, n_elements):
                if end > begin:
                    found.append((e, pad, InnerShape(element, begin, end, length)))
                    if end - begin > _WHOLE * whole:
                        covered.add(e)
        own = InnerShape(element, 0.0, whole, whole)
        found += [(e, NO_PAD, own) for e in range(n_elements) if e not in covered]
        elements, pads, shapes = zip(*found, strict=True)
        unique = {shape: shape for shape in shapes}
        return cls(
            np.array(elements, dtype=np.int64),
            np.array(pads, dtype=np.int64),
            tuple(unique[shape] for shape in shapes),
            n_elements,
        )

    @cached_property
    def flexibility(self) -> Array:
        """(nb,) average of each shape over its own footprint, for its 1 N [m/N]."""
        return np.array([average(shape, shape) for shape in self.shapes])

    @cached_property
    def slots(self) -> IntArray:
        """(n_elements, most on one element) dofs of each element, -1 for none."""
        counts = np.bincount(self.elements, minlength=self.n_elements)
        slots = np.full((self.n_elements, int(counts.max())), -1, dtype=np.int64)
        taken = np.zeros(self.n_elements, dtype=np.int64)
        for dof, element in enumerate(self.elements):
            slots[element, taken[element]] = dof
            taken[element] += 1
        return slots

    def _average(self, over: int, dof: int) -> float:
        """Average over the footprint of one dof of the scaled shape of another."""
        return average(self.shapes[dof], self.shapes[over]) / float(self.flexibility[dof])

    def _pairs(self) -> Iterator[tuple[int, int, int, int, int]]:
        """Element, two slots of it, and their dofs."""
        used = self.slots >= 0
        for e, i, j in np.argwhere(used[:, :, None] & used[:, None, :]).tolist():
            yield e, i, j, int(self.slots[e, i]), int(self.slots[e, j])

    @cached_property
    def _energies(self) -> Array:
        """(n_elements, k, k) stiffness of the dofs of each element, identity for no dof.

        The energy of two shapes is the work of the one's force on the other.
        """
        energies = np.tile(np.eye(self.slots.shape[1]), (self.n_elements, 1, 1))
        for e, i, j, one, other in self._pairs():
            energies[e, i, j] = self._average(one, other) / self.flexibility[one]
        return energies

    def pad_weights(self, pad: int) -> tuple[IntArray, Array]:
        """Dofs and weights with which the inner dofs enter the average over one pad.

        A pad of no length stands on a node, where every inner shape is zero: it has none.
        """
        pairs = [
            (dof, self._average(int(own), int(dof)))
            for own in np.flatnonzero(self.pads == pad)
            for dof in self.slots[self.elements[own]]
            if dof >= 0
        ]
        dofs, weights = [dof for dof, _ in pairs], [weight for _, weight in pairs]
        return np.array(dofs, dtype=np.int64), np.array(weights, dtype=float)

    def values(self, element: IntArray, xi: Array) -> tuple[IntArray, Array]:
        """Dofs (m, k), -1 for none, and the values of their shapes (m, k) at local xi (m,)."""
        dofs = self.slots[element]
        values = np.zeros(dofs.shape)
        different, numbers = self._different
        for number, shape in enumerate(different):
            rows, columns = np.nonzero(numbers[dofs] == number)
            deflection, _ = shape(xi[rows] * shape.element.length)
            values[rows, columns] = deflection / self.flexibility[dofs[rows, columns]]
        return dofs, values

    @cached_property
    def _different(self) -> tuple[list[InnerShape], IntArray]:
        """The different shapes, and the number of each dof's; last, for the dof -1, none."""
        different = list(dict.fromkeys(self.shapes))
        numbers = {shape: number for number, shape in enumerate(different)}
        return different, np.array([*(numbers[shape] for shape in self.shapes), -1])

    def compliance(self, element: IntArray, xi: Array) -> Array:
        """Share of the inner dofs in the compliance of the clamped element, (m,) [m/N]."""
        _, values = self.values(element, xi)
        inverse = np.linalg.inv(self._energies)[element]
        return np.einsum("mi,mij,mj->m", values, inverse, values)

    def with_stiffness(self, nodal: sp.csr_array) -> sp.csr_array:
        """Stiffness with these dofs behind the nodal ones; the two do not couple."""
        inner = sp.lil_array((len(self.shapes), len(self.shapes)))
        for e, i, j, one, other in self._pairs():
            inner[one, other] = self._energies[e, i, j]
        return sp.csr_array(sp.block_diag((nodal, inner)))

    def with_gram(self, nodal: sp.csr_array, per_length: float, rotary: float) -> sp.csr_array:
        """Add these dofs to the integral of per_length w w' + rotary theta theta'.

        The mass matrix, and a uniform foundation with rotary 0.
        """
        n, nb = nodal.shape[0], len(self.shapes)
        inner = sp.lil_array((nb, nb))
        for _, _, _, one, other in self._pairs():
            scale = self.flexibility[one] * self.flexibility[other]
            inner[one, other] = (
                gram(self.shapes[one], self.shapes[other], per_length, rotary) / scale
            )
        coupling = np.array([gram_with_nodes(shape, per_length, rotary) for shape in self.shapes])
        coupling /= self.flexibility[:, None]
        columns = 2 * self.elements[:, None] + np.arange(4)
        corner = sp.csr_array(
            (coupling.ravel(), (np.repeat(np.arange(nb), 4), columns.ravel())), shape=(nb, n)
        )
        return sp.csr_array(sp.block_array([[nodal, corner.T], [corner, inner]]))
