"""What a passage reads before anything runs, and what goes into each of its runs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import InputError
from contactstudy.given_files import content_digest
from contactstudy.irregularity.shown import to_dataset
from contactstudy.profiles.wheel_file import named_file_digest
from contactstudy.store import digest
from contactstudy.study.kind import Inputs, Work
from contactstudy.study.kinds.passage.build import journey, recipe
from contactstudy.study.kinds.passage.contact import hertz
from contactstudy.study.kinds.passage.held_against import to_dataset as record_dataset
from contactstudy.study.kinds.passage.placing import contact_zone, scan_meeting
from contactstudy.study.kinds.passage.remarks import remarks
from contactstudy.study.kinds.passage.roughness import Described, describe
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.scan import PATHS as SCAN_PATHS
from contactstudy.study.kinds.passage.schema import IRREGULARITY, MEASURED, Study
from contactstudy.study.kinds.passage.touching import touched_beyond
from contactstudy.study.kinds.passage.twins import all_pieces, changes, run_of
from contactstudy.study.kinds.passage.wheelset import PATHS as WHEELSET_PATHS
from contactstudy.study.kinds.passage.wrong_files import wrong_files
from contactstudy.validation import multiple
from contactstudy.vehicle import Bogie, Train
from contactstudy.vehicle.consist import car_file

if TYPE_CHECKING:
    import xarray as xr

#: Steps of a beam that take about as long as a process takes to start.
LIGHT = 20_000
# keys of a point run that decide its matrices
_STEPPING = (
    "rail", "elements_per_bay", "local_compliance", "direction", "time_step", "integrator",
    "rho_inf",
)  # fmt: skip


def read_inputs(study: Study) -> Inputs:
    """Read a study's irregularity, section, profiles and scans.

    Raises
    ------
    InputError
        When files cannot be used.
    """
    try:
        return _read(study)
    except InputError as error:
        more = wrong_files(vars(study), study.runs)
        raise InputError(dict.fromkeys([*error.problems, *more])) from error


def _read(study: Study) -> Inputs:
    described = describe(study)
    config = study.config()
    for key in ("file", "measured_overlay", "wheel_defect_file"):
        if config["irregularity"].get(key):  # the content counts, and paths are the machine's
            config["irregularity"][key] = Path(config["irregularity"][key]).name
    files = dict(described.files)
    if "wheelset" in config:
        contact_zone(study)  # refused before anything is computed
    _cars(config.get("vehicle", {}), files)
    if "measured" in config:
        path = Path(study.measured.file)
        files[path.name] = content_digest(path)
        config["measured"]["file"] = path.name
    section = study.solid.wheel_section
    if digest := named_file_digest(section):
        files[Path(section).name] = digest
        if "solid" in config:
            config["solid"]["wheel_section"] = Path(section).name
    for key in WHEELSET_PATHS:
        name = getattr(study.wheelset, key)
        if "wheelset" in config and (digest := named_file_digest(name)):
            files[Path(name).name] = digest
            config["wheelset"][key] = Path(name).name
    if "roughness" in config:
        name = Path(study.roughness.file).name
        files[name] = content_digest(study.roughness.file)
        config["roughness"] |= {"file": name, "levels": study.roughness.levels()}
    notes = described.warnings + remarks(study) + _scans(study, config, files)
    if "wheelset" in config and (rail_name := study.track.rail.profile_name) is not None:
        notes += tuple(n for curve in study.wheelset.curves(rail_name) for n in curve.notes)
    notes += touched_beyond(study) + tuple(_hertz_instead(study))
    meshed = bool(study.runs) and study.track.rail.profile_name is not None
    return Inputs(
        config,
        files,
        notes,
        groups=lambda: _groups(study, described),
        seed=config["irregularity"].get("seed"),
        mesh=lambda: asdict(recipe(study)) if meshed else None,
    )


def _groups(study: Study, described: Described) -> dict[str, xr.Dataset]:
    found = {IRREGULARITY: to_dataset(described.info)}
    if study.runs and study.measured.used:
        found[MEASURED] = record_dataset(study.measured)
    return found


def _cars(vehicle: dict[str, Any], files: dict[str, str]) -> None:
    """Enter the files of cars."""
    for key in ("cars", "car"):
        texts = vehicle.get(key, [])
        for text in [texts] if isinstance(texts, str) else texts:
            path = car_file(text)
            if digest := named_file_digest(path):
                files[Path(path).name] = digest
                shown = text.replace(path, Path(path).name)
                vehicle[key] = (
                    shown
                    if isinstance(texts, str)
                    else [shown if old == text else old for old in vehicle[key]]
                )


def _hertz_instead(study: Study) -> Iterator[str]:
    """Stiffnesses named after the press that are Hertz's, for nothing can be pressed."""
    for name, run in study.runs.items():
        if isinstance(run, PointRun) and run.law_of_press and not study.presses(name):
            closed = hertz(study)
            value = (
                closed.secant_stiffness if "secant" in str(run.k_r) else closed.tangent_stiffness
            )
            yield (
                f'runs.{name}.k_r = "{run.k_r}": is that of Hertz\'s closed form, '
                f'{multiple(str(run.k_r))[0] * value:.4g} N/m; a rail that is "given" has no '
                "profile to press"
            )


def _scans(study: Study, config: dict[str, Any], files: dict[str, str]) -> tuple[str, ...]:
    """Check the scans, enter them and their residuals; how well they are fitted."""
    if "scan" not in config:
        return ()
    found = scan_meeting(study)
    for key in SCAN_PATHS:
        if name := getattr(study.scan, key):
            files[Path(name).name] = content_digest(name)
            config["scan"][key] = Path(name).name
    config["scan"] |= study.scan.fitted()
    scans = [scan for scan in study.scan.surfaces() if scan is not None]
    notes = [f"scan {scan.summary()}" for scan in scans]
    notes += [f"scan {scan.doubt}" for scan in scans if scan.doubt]
    assert found is not None
    return (
        *notes,
        "scan: facets touch "
        f"{1e6 * abs(found.difference):.3g} um {'lower' if found.difference > 0 else 'higher'} "
        "than the smooth surfaces",
    )


def work(study: Study, inputs: Inputs) -> list[Work]:
    """A piece a run, and one a twin."""

    def piece(name: str) -> Work:
        run, changed = run_of(name), changes(study, name)
        long = study.runs[run].needs_solid
        light = not long and study.wheel(run) != "modal" and journey(study, run).n_steps <= LIGHT
        batch = _batch(study, inputs, run) if light else ""
        own = _run_inputs(study, inputs, run, changed)
        return Work(name, own, long=long, light=light, batch=batch)

    return [piece(name) for name in all_pieces(study)]


def _batch(study: Study, inputs: Inputs, run: str) -> str:
    """Hash of what runs share that are stepped together: the matrices of a step."""
    table = study.resolved_run(run)
    shared = [inputs.config[key] for key in ("track", "vehicle")]
    shared += study.vehicle.data if isinstance(study.vehicle, Train | Bogie) else []
    stepping = [table.get(key) for key in _STEPPING]
    return digest([shared, study.solid.mesh_size, stepping, study.time_step(run)])


def _run_inputs(study: Study, inputs: Inputs, run: str, changed: dict[str, Any]) -> list[Any]:
    """Everything that goes into one run, as plain data; the contents of files stand apart."""
    own = study.resolved_run(run) | changed
    apart = {"runs", "compare", "solid", "measured", "roughness"} | (
        {"irregularity"} if own["irregularity"] == "smooth" else set()
    )
    shared = {k: v for k, v in inputs.config.items() if k not in apart}
    # Beams take their section from the solid's mesh, so its size matters to them as well.
    solid = study.solid.resolved() | {"wheel_section": Path(study.solid.wheel_section).name}
    shared["solid"] = solid if study.meshes_rail(run) else solid["mesh_size"]
    if isinstance(study.vehicle, Train | Bogie):
        shared["cars"] = study.vehicle.data
    # with modes in another run the wheel is meshed more finely round its circumference
    shared["modes"] = study.meshes_wheel(run) and study.has_wheel_modes
    return [own, shared]
