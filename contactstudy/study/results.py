"""What a finished study is: labelled runs, metrics, and everything the report needs.

Layout of an output directory::

    result.nc       root: attributes of the study; group ``irregularity``; one group a run
    metrics.json    sizes, times, memory and error norms
    figures/        *.pdf and *.png; patch.gif where frames are kept
    fields/         *.vtu and *.pvd for ParaView, where instants are kept
    report.pdf
    runs/           the store of single runs (see `contactstudy.store`)
    <companion>/    a companion study, laid out the same way

``result.nc`` holds nothing that depends on the machine: the same inputs give the same bytes.
Times and memory are in ``metrics.json`` only.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.files import writing
from contactstudy.store import netcdf_attributes

if TYPE_CHECKING:
    import xarray as xr

RESULT_FILE = "result.nc"
METRICS_FILE = "metrics.json"
IRREGULARITY_GROUP = "irregularity"


@dataclass(frozen=True)
class Spectrum:
    """Samples of a power spectral density of the vertical irregularity.

    Attributes
    ----------
    label : str
        Text for a legend.
    wavenumber : (n,) array
        Angular wavenumber in rad/m, increasing.
    density : (n,) array
        Two-sided density G in m^2/(rad/m): the variance is the integral over both signs of
        the wavenumber, 2 * int_0^inf G dω.
    band : (2,) tuple of float
        Wavenumbers in rad/m between which the density is valid.
    """

    label: str
    wavenumber: Array
    density: Array
    band: tuple[float, float]


@dataclass(frozen=True)
class Level:
    """A profile over position: ``position`` (n,) in m and ``level`` (n,) in m, up positive."""

    label: str
    position: Array
    level: Array


@dataclass(frozen=True)
class IrregularityInfo:
    """Everything Figs 1a and 1b show.

    Attributes
    ----------
    spectrum : Spectrum or None
        The formula, e.g. eq. (3); None when the study's irregularity is a measured profile.
    estimate : Spectrum or None
        Spectral estimate of the profile in use; None for a smooth rail.
    profile : Level or None
        The profile in use over the track (before it is faded in).
    measured : Spectrum or None
        Spectral estimate of a measured profile, with the band in which it is valid.
    measured_profile : Level or None
        The measured level itself, band-passed.
    """

    spectrum: Spectrum | None = None
    estimate: Spectrum | None = None
    profile: Level | None = None
    measured: Spectrum | None = None
    measured_profile: Level | None = None


@dataclass(frozen=True)
class StudyResults:
    """A finished study.

    Attributes
    ----------
    name, title, description : str
        As in the study file; ``name`` is the file's stem.
    config : mapping
        The resolved study as nested plain dicts, SI values (numbers, strings, booleans, lists).
    units : mapping of str to str
        Dotted key of ``config`` -> SI unit of its value; keys without unit are left out.
    runs : mapping of str to xarray.Dataset
        One dataset a run in the order of the study file; see `contactstudy.solvers.dataset`.
    reference : str or None
        Name of the run the others are compared with; None when there is nothing to compare.
    metrics : mapping
        Content of ``metrics.json``, see `contactstudy.study.kinds.passage.metrics`. Its
        ``runs.<name>.seconds`` and ``peak_memory_mb`` depend on the machine.
    irregularity : IrregularityInfo
        Spectra and profiles for Fig. 1.
    provenance : mapping
        ``seed``, ``hash`` (of all parameters), ``versions`` (package -> version), ``mesh``
        (the recipe of the solid rail, or None), ``files`` (input file -> SHA-256), ``sources``
        (lines of text about input files).
    companions : tuple of StudyResults
        Studies whose results stand in the same report.
    """

    name: str
    title: str
    description: str
    config: Mapping[str, Any]
    units: Mapping[str, str]
    runs: Mapping[str, xr.Dataset]
    reference: str | None
    metrics: Mapping[str, Any]
    irregularity: IrregularityInfo = field(default_factory=IrregularityInfo)
    provenance: Mapping[str, Any] = field(default_factory=dict)
    companions: tuple[StudyResults, ...] = ()


_ROOT_TEXTS = ("name", "title", "description")
_ROOT_JSON = ("config", "units", "provenance")


def write_results(results: StudyResults, out_dir: Path) -> None:
    """Write ``result.nc`` and ``metrics.json`` of a study (not its companions) into `out_dir`.

    Both are written beside their final place and renamed, so that neither is ever half there.
    """
    import xarray as xr

    out_dir = Path(out_dir)
    with writing(out_dir / RESULT_FILE) as path:
        root = xr.Dataset(attrs={key: getattr(results, key) for key in _ROOT_TEXTS})
        root.attrs["Conventions"] = "CF-1.11"
        for key in _ROOT_JSON:
            root.attrs[key] = json.dumps(getattr(results, key), ensure_ascii=False)
        root.attrs["runs"] = json.dumps(list(results.runs))
        root.attrs["companions"] = json.dumps([c.name for c in results.companions])
        root.attrs["reference"] = results.reference or ""
        root.to_netcdf(path, engine="h5netcdf", mode="w")
        _irregularity_dataset(results.irregularity).to_netcdf(
            path, engine="h5netcdf", mode="a", group=IRREGULARITY_GROUP
        )
        for name, run in results.runs.items():
            clean = netcdf_attributes(run)
            clean.to_netcdf(path, engine="h5netcdf", mode="a", group=name)
    with writing(out_dir / METRICS_FILE) as path:
        path.write_text(json.dumps(results.metrics, indent=2, ensure_ascii=False) + "\n", "utf-8")


def read_results(out_dir: Path) -> StudyResults:
    """Read a study and its companions from the directory that `write_results` wrote.

    Raises
    ------
    InputError
        When a file is missing or damaged.
    """
    import xarray as xr

    out_dir = Path(out_dir)
    path = out_dir / RESULT_FILE
    try:
        root = xr.load_dataset(path, engine="h5netcdf")
        loaded: dict[str, Any] = {key: root.attrs[key] for key in _ROOT_TEXTS}
        loaded |= {key: json.loads(root.attrs[key]) for key in _ROOT_JSON}
        info = xr.load_dataset(path, engine="h5netcdf", group=IRREGULARITY_GROUP)
        runs = {
            name: xr.load_dataset(path, engine="h5netcdf", group=name)
            for name in json.loads(root.attrs["runs"])
        }
        metrics = json.loads((out_dir / METRICS_FILE).read_text("utf-8"))
        companions = json.loads(root.attrs["companions"])
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        raise InputError(
            f"{out_dir}: cannot be read as results of a study ({error}); run the study again"
        ) from error
    return StudyResults(
        **loaded,
        runs=runs,
        reference=root.attrs["reference"] or None,
        metrics=metrics,
        irregularity=_irregularity_info(info),
        companions=tuple(read_results(out_dir / name) for name in companions),
    )


_SPECTRA = ("spectrum", "estimate", "measured")
_LEVELS = ("profile", "measured_profile")


def _irregularity_dataset(info: IrregularityInfo) -> xr.Dataset:
    import xarray as xr

    data = xr.Dataset()
    for key in _SPECTRA:
        spectrum = getattr(info, key)
        if spectrum is not None:
            k = f"{key}_wavenumber"
            data[k] = (k, spectrum.wavenumber, {"units": "rad/m"})
            attrs = {"units": "m^2/(rad/m)", "sides": "two", "long_name": spectrum.label}
            data[f"{key}_density"] = (k, spectrum.density, attrs)
            data[f"{key}_density"].attrs["valid_band"] = list(spectrum.band)
    for key in _LEVELS:
        level = getattr(info, key)
        if level is not None:
            x = f"{key}_position"
            data[x] = (x, level.position, {"units": "m"})
            data[key] = (x, level.level, {"units": "m", "long_name": level.label})
    return data


def _irregularity_info(data: xr.Dataset) -> IrregularityInfo:
    parts: dict[str, Any] = {}
    for key in _SPECTRA:
        if f"{key}_density" in data:
            density = data[f"{key}_density"]
            low, high = density.attrs["valid_band"]
            parts[key] = Spectrum(
                density.attrs["long_name"],
                data[f"{key}_wavenumber"].values,
                density.values,
                (float(low), float(high)),
            )
    for key in _LEVELS:
        if key in data:
            parts[key] = Level(
                data[key].attrs["long_name"], data[f"{key}_position"].values, data[key].values
            )
    return IrregularityInfo(**parts)
