"""A study whose inputs have been read, with the hashes by which finished work is found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from contactstudy.files import file_digest as digest_of
from contactstudy.profiles.wheel_file import file_digest
from contactstudy.provenance import versions
from contactstudy.store import DATASET, Store, store_key
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.placing import contact_zone, scan_meeting
from contactstudy.study.kinds.passage.roughness import describe
from contactstudy.study.kinds.passage.scan import PATHS as SCAN_PATHS
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.wheelset import PATHS as WHEELSET_PATHS
from contactstudy.study.loading import load_companions
from contactstudy.study.results import IrregularityInfo

RUNS = "runs"
"""Folder of the output in which finished runs are kept."""


@dataclass(frozen=True)
class Plan:
    """A study whose inputs have been read, and where its results go."""

    study: Study
    out_dir: Path
    irregularity: IrregularityInfo
    inputs: Mapping[str, Any]
    files: Mapping[str, str]
    warnings: tuple[str, ...] = ()
    companions: tuple[Plan, ...] = ()

    @property
    def all(self) -> tuple[Plan, ...]:
        """This plan, then its companions'."""
        return (self, *(p for c in self.companions for p in c.all))

    @property
    def runs(self) -> Store:
        """Where finished runs are kept."""
        return Store(self.out_dir / RUNS, DATASET)

    def run_key(self, run: str) -> str:
        """Hash of everything that goes into one run, code included."""
        study = self.study
        table = study.config()["runs"][run]
        shared = {k: v for k, v in self.inputs.items() if k not in ("runs", "compare", "solid")}
        # Beams take their section from the solid's mesh, so its size matters to them as well.
        solid = study.solid.resolved() | {"wheel_section": Path(study.solid.wheel_section).name}
        shared["solid"] = solid if study.bodies(run) else solid["mesh_size"]
        # with modes in another run the wheel is meshed more finely round its circumference
        shared["modes"] = "wheel" in study.bodies(run) and study.has_wheel_modes
        return store_key([run, table, shared, dict(self.files)], execute_run)

    def key(self) -> str:
        """Hash of everything that goes into the results, drawing and printing included."""
        texts = [self.study.name, self.study.title, self.study.description]
        own = [texts, self.inputs, dict(self.files), versions()]
        return store_key([own, [companion.key() for companion in self.companions]], None)


def plan_study(study: Study, out_dir: Path) -> Plan:
    """Read a study's inputs and its companions'.

    Raises
    ------
    InputError
        When an input file cannot be used, or a companion's study file.
    """
    companions = [plan_study(c, out_dir / c.name) for c in load_companions(study)]
    described = describe(study)
    inputs = study.config()
    for key in ("file", "measured_overlay"):
        if inputs["irregularity"].get(key):  # the content counts, and paths are the machine's
            inputs["irregularity"][key] = Path(inputs["irregularity"][key]).name
    files = dict(described.files)
    if "wheelset" in inputs:
        contact_zone(study)  # refused before anything is computed
    section = study.solid.wheel_section
    if digest := file_digest(section):
        files[Path(section).name] = digest
        if "solid" in inputs:
            inputs["solid"]["wheel_section"] = Path(section).name
    for key in WHEELSET_PATHS:
        name = getattr(study.wheelset, key)
        if "wheelset" in inputs and (digest := file_digest(name)):
            files[Path(name).name] = digest
            inputs["wheelset"][key] = Path(name).name
    notes = described.warnings + _scans(study, inputs, files)
    return Plan(
        study=study,
        out_dir=out_dir,
        irregularity=described.info,
        inputs=inputs,
        files=files,
        warnings=notes,
        companions=tuple(companions),
    )


def _scans(study: Study, inputs: dict[str, Any], files: dict[str, str]) -> tuple[str, ...]:
    """Check the scans, enter them and their residuals; how well they are fitted."""
    if "scan" not in inputs:
        return ()
    found = scan_meeting(study)
    for key in SCAN_PATHS:
        if name := getattr(study.scan, key):
            files[Path(name).name] = digest_of(Path(name))
            inputs["scan"][key] = Path(name).name
    inputs["scan"] |= study.scan.fitted()
    notes = [f"scan {scan.summary()}" for scan in study.scan.surfaces() if scan is not None]
    assert found is not None
    return (
        *notes,
        "scan: facets touch "
        f"{1e6 * abs(found.difference):.3g} um {'lower' if found.difference > 0 else 'higher'} "
        "than the smooth surfaces",
    )
