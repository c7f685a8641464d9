"""Runs of schemes and of surface contact on the samples of a study, kept in a folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from contactstudy.advice.samples import Samples, Varied, varied
from contactstudy.advice.schemes import FAMILIES, Scheme, schemes
from contactstudy.compare import norms
from contactstudy.compare.signals import dynamic, position, side_by_side, values
from contactstudy.driver import compute_study
from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.reporter import NotedOnce, Reporter, WithoutNotes
from contactstudy.study.kinds.passage import contact, forecast
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.runs import SOLVERS
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.validation import raise_if, read

if TYPE_CHECKING:
    import xarray as xr

_FACTOR = 2**0.5
_TWINS = ((_FACTOR, _FACTOR), (_FACTOR, 1.0), (1.0 / _FACTOR, 1.0))
"""Factors of mesh size and time step of what the reference is compared with: the first possible."""
_COUNTERPARTS = {
    "bay_8_1": ("stiff", "tangent", "shear", "filtered", "press"),
    "press_8_1": tuple(FAMILIES),
    "tangent_8_1": tuple(FAMILIES),
}
"""Schemes from which the difference of another shows how its error varies -> of which families.

The first that is possible is taken, of another family than the scheme's.
"""


@dataclass(frozen=True)
class Trials:
    """A study whose runs are schemes and surface contact."""

    REFERENCE: ClassVar[str] = "surface"

    study: Study
    part: str
    folder: Path
    workers: int
    reporter: Reporter | None

    @classmethod
    def of(
        cls, study: Study, part: str, folder: Path, workers: int, reporter: Reporter | None
    ) -> Trials:
        """Of a study without its own runs; `part` of the force, total or dynamic."""
        solid = replace(study.solid, pressure_at=(), animation_frames=0, animation_span=())
        runs = {cls.REFERENCE: _run(cls.REFERENCE, {"solver": "surface", "wheel": "modal"})}
        made = replace(
            study,
            solid=solid,
            runs=runs,
            reference=cls.REFERENCE,
            companions=(),
            measured=MeasuredRecord(),
            smooth=False,
            rungs=False,
            softer=0.0,
        )
        return cls(made, part, folder, workers, None if reporter is None else NotedOnce(reporter))

    @property
    def start(self) -> float:
        """Where the irregularity is whole [m]."""
        return self.study.journey.start + self.study.journey.fade_in

    def with_schemes(self, added: Mapping[str, Scheme], study: Study | None = None) -> Study:
        """The study with these runs beside surface contact."""
        made = {name: _run(name, scheme.table) for name, scheme in added.items()}
        study = study or self.study
        return replace(study, runs=study.runs | made)

    def size(self, name: str, scheme: Scheme) -> tuple[int, int, float] | None:
        """Dofs, steps and seconds of a scheme, about; None where the study does not allow it."""
        try:
            return forecast.size(self.with_schemes({name: scheme}), name)
        except InputError:
            return None

    def seconds(self) -> float:
        """What surface contact takes, about."""
        return forecast.size(self.study, self.REFERENCE)[2]

    def run(
        self, wanted: Mapping[str, Scheme], study: Study | None = None
    ) -> tuple[Mapping[str, xr.Dataset], dict[str, str]]:
        """Runs of schemes and surface contact; why others failed.

        Raises
        ------
        ContactStudyError
            When surface contact did.
        """
        try:
            return self._compute(self.with_schemes(wanted, study)), {}
        except ContactStudyError:
            found, failures = dict(self._compute(study or self.study)), dict[str, str]()
            for name, scheme in wanted.items():
                try:
                    found |= self._compute(self.with_schemes({name: scheme}, study))
                except ContactStudyError as error:
                    failures[name] = str(error).splitlines()[0]
            return found, failures

    def error(self, run: xr.Dataset, reference: xr.Dataset) -> float:
        """Relative L2 difference of two contact forces."""
        part = values if self.part == "total" else dynamic
        of = partial(part, name="contact_force")
        x, a, b = side_by_side(run, reference, of, self.start)
        return norms.relative_l2(a, b, x)

    def reference_error(self) -> float:
        """How far surface contact is from itself on a coarser mesh, in longer time steps.

        An error of second order, as the time step's is, halves from sqrt 2 times the size to the
        size: it is as large as the difference. The mesh is finer where a coarser one is impossible.
        """
        for mesh, step in _TWINS:
            try:
                other = self._with_mesh(mesh, step)
                pair = (self._compute(one)[self.REFERENCE] for one in (other, self.study))
                return self.error(*pair)
            except InputError:  # such a mesh is not possible, or waves too short for such steps
                continue
        return 0.0

    def _with_mesh(self, mesh: float, step: float) -> Study:
        """The study with the mesh size and the time step multiplied."""
        solid, journey = self.study.solid, self.study.journey
        size = mesh * solid.mesh_size
        return replace(
            self.study,
            solid=replace(
                solid, mesh_size=size, coarse_mesh_size=max(solid.coarse_mesh_size, size)
            ),
            journey=replace(journey, time_step=step * journey.time_step),
        )

    def lost(self) -> float:
        """Share of the way on which surface contact loses contact."""
        run = self._compute(self.study)[self.REFERENCE]
        force = values(run, "contact_force")[position(run) >= self.start]
        return float(np.mean(force <= 0.0))

    def differences(self, wanted: Mapping[str, Scheme], over: Samples) -> dict[str, Varied]:
        """Of schemes from a counterpart each, on all samples."""
        found = dict.fromkeys(wanted, Varied(()))
        every = schemes(self.study.journey.time_step)
        for other, families in _COUNTERPARTS.items():
            own = {
                name: scheme
                for name, scheme in wanted.items()
                if not found[name].differences
                and scheme.family in families
                and scheme.family != every[other].family
            }
            if not own or self.size(other, every[other]) is None:
                continue
            both = self.with_schemes({other: every[other], **own})
            points = replace(both, runs={n: both.runs[n] for n in (other, *own)}, reference=other)
            found |= varied(points, over, self.part, self.folder, self._mute)
        return {name: found[name] for name in wanted}

    def proof(self, name: str, scheme: Scheme, over: Samples) -> float:
        """Error of a scheme on the sample after the study's own; infinite where it fails."""
        runs, failures = self.run({name: scheme}, over.of(self.study, 1))
        return float("inf") if failures else self.error(runs[name], runs[self.REFERENCE])

    def contact(self, name: str, scheme: Scheme) -> dict[str, float]:
        """Stiffness of a scheme's contact [N/m], and length [m] over which its filter averages."""
        study = self.with_schemes({name: scheme})
        given = scheme.table.get("k_r")
        if isinstance(given, float):
            stiffness = given
        else:
            stiffness = float(contact.press_table(study, name).tangent)
        mean = contact.contact_filter(study, name)
        if not isinstance(mean, contact.PatchMean):
            return {"stiffness": stiffness, "patch": 0.0}
        # uniform over 2a the offsets have the mean square a^2/3
        half = float(np.sqrt(3.0 * (mean.weights @ mean.offsets**2)))
        return {"stiffness": stiffness, "patch": 2.0 * half}

    def _compute(self, study: Study) -> Mapping[str, xr.Dataset]:
        here, reporter = self.workers == 1, self.reporter if study == self.study else self._mute
        return compute_study(study, self.folder, self.workers, reporter, here=here).runs

    @property
    def _mute(self) -> Reporter | None:
        """Of schemes and meshes that are only tried nobody is warned: they are judged by errors."""
        return None if self.reporter is None else WithoutNotes(self.reporter)


def _run(name: str, table: Mapping[str, Any]) -> Any:
    made, problems = read(SOLVERS, table, f"runs.{name}")
    raise_if(problems)
    return made
