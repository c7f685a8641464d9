"""What a finished study of any kind is: labelled runs, metrics, and where they come from.

Layout of an output directory::

    result.nc       root: attributes of the study; a group a run; groups of the kind beside them
    metrics.json    sizes, times, memory and norms
    figures/        *.pdf and *.png
    report.pdf
    report.html     the same for the screen, its figures drawn from their data
    sweep.csv       what was measured of each variant of a study with axes
    runs/           the store of single pieces of work (see `contactstudy.store`)
    <companion>/    a companion study, laid out the same way

A kind of study may add files of its own. ``result.nc`` holds nothing that depends on the machine:
the same inputs give the same bytes. Times and memory are in ``metrics.json`` only.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import InputError
from contactstudy.files import write_file, writing
from contactstudy.store import netcdf_attributes
from contactstudy.study.packing import packed
from contactstudy.texts import json_text

if TYPE_CHECKING:
    import xarray as xr

    from contactstudy.study.tree import ResultTree

RESULT_FILE = "result.nc"
METRICS_FILE = "metrics.json"
REPORT_FILE = "report.pdf"
PAGE_FILE = "report.html"
SWEEP_FILE = "sweep.csv"
FIGURES = "figures"
RUNS = "runs"
"""Folder in which finished pieces of work are kept."""
OUTPUTS = (RESULT_FILE, METRICS_FILE, REPORT_FILE, PAGE_FILE, SWEEP_FILE, FIGURES, RUNS)


@dataclass(frozen=True)
class StudyResults:
    """A finished study; name (the file's stem), title and description are the study file's."""

    name: str
    title: str
    description: str
    #: The resolved study as nested plain dicts, SI values (numbers, strings, booleans, lists).
    config: Mapping[str, Any]
    #: Dotted key of ``config`` -> SI unit of its value; keys without unit are left out.
    units: Mapping[str, str]
    #: One dataset a run in the order of the study file; a run of a variant is "variant/run".
    runs: Mapping[str, xr.Dataset]
    #: Name of the run the others are compared with; None when there is nothing to compare.
    reference: str | None
    #: Content of ``metrics.json``. Its ``runs.<name>.seconds`` and ``peak_memory_mb`` depend on
    #: the machine.
    metrics: Mapping[str, Any]
    #: What the study computes, see `contactstudy.study.kind`.
    kind: str = "passage"
    #: What belongs to the study and not to one run; names are those of groups in ``result.nc``.
    groups: Mapping[str, xr.Dataset] = field(default_factory=dict)
    #: ``seed``, ``hash`` (of all parameters), ``versions`` (package -> version), ``code`` (hash of
    #: the program), ``mesh`` (the recipe of the solid rail, or None), ``files`` (input file ->
    #: SHA-256).
    provenance: Mapping[str, Any] = field(default_factory=dict)
    #: Studies whose results stand in the same report.
    companions: tuple[StudyResults, ...] = ()

    @property
    def designs(self) -> dict[str, xr.Dataset]:
        """What was measured of the variants of a study with axes, a dataset a design."""
        return {name: data for name, data in self.groups.items() if "design" in data.attrs}

    @property
    def swept(self) -> bool:
        """Whether the study has axes; then it has no runs of its own."""
        return bool(self.designs)

    @property
    def failures(self) -> dict[str, str]:
        """Variant, told by its values, -> why it could not be computed; of companions too."""
        own = self.metrics.get("variants", {}).values()
        found = {v["title"]: v["failure"] for v in own if "failure" in v}
        for companion in self.companions:
            found |= {f"{companion.name}: {k}": v for k, v in companion.failures.items()}
        return found

    @property
    def tree(self) -> ResultTree:
        """Runs and other groups as one tree, the study's attributes at its root."""
        import xarray as xr

        from contactstudy.study.tree import ResultTree

        attrs = {key: getattr(self, key) for key in _TEXTS} | {"Conventions": "CF-1.11"}
        for key in _JSON:
            attrs[key] = json_text(getattr(self, key))
        attrs["runs"] = json.dumps(list(self.runs))
        attrs["companions"] = json.dumps([c.name for c in self.companions])
        attrs["reference"] = self.reference or ""
        parts = {name: netcdf_attributes(run) for name, run in self.runs.items()}
        return ResultTree.from_dict({"/": xr.Dataset(attrs=attrs), **self.groups, **parts})

    def __repr__(self) -> str:
        return f"<results of the study {self.name}>\n{self.tree}"

    def _repr_html_(self) -> str:
        return str(self.tree._repr_html_())


_TEXTS = ("kind", "name", "title", "description")
_JSON = ("config", "units", "provenance")


def write_results(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write ``result.nc`` and ``metrics.json`` of a study (not its companions) into `out_dir`.

    Both are written beside their final place and renamed, so that neither is ever half there.
    """
    files = [Path(out_dir) / RESULT_FILE, Path(out_dir) / METRICS_FILE]
    with writing(files[0]) as stream:
        tree = results.tree
        tree.to_netcdf(stream, engine="h5netcdf", encoding=packed(tree))
    write_file(files[1], json_text(results.metrics, indent=2) + "\n")
    return files


def open_results(out_dir: str | Path) -> ResultTree:
    """The tree of a finished study: a node a run, the study's attributes at the root.

    The node ``norms`` tells how far each run is from the reference. It is an `xarray.DataTree`,
    which ``xarray.open_datatree`` makes of ``result.nc`` as well; a notebook shows the runs and
    their norms above it.

    Parameters
    ----------
    out_dir : str or Path
        Its folder, or its ``result.nc``.

    Raises
    ------
    InputError
        When ``result.nc`` is missing or damaged.
    """
    import xarray as xr

    from contactstudy.study.tree import ResultTree

    if not isinstance(out_dir, str | Path):
        raise InputError(f"out_dir = {out_dir!r}: must be the folder of a study's results")
    path = Path(out_dir)
    try:
        file = path if path.is_file() else path / RESULT_FILE
        with xr.open_datatree(file, engine="h5netcdf") as tree:
            parts = {path: node.to_dataset(inherit=False) for path, node in tree.subtree_with_keys}
            return ResultTree.from_dict(parts).load()
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        raise _unreadable(path, error) from error


def read_results(out_dir: str | Path) -> StudyResults:
    """Read a study and its companions from the directory that `write_results` wrote.

    Raises
    ------
    InputError
        When a file is missing or damaged.
    """
    tree, out_dir = open_results(out_dir), Path(out_dir)
    out_dir = out_dir.parent if out_dir.is_file() else out_dir
    try:
        loaded = {key: tree.attrs[key] for key in _TEXTS}
        loaded |= {key: json.loads(tree.attrs[key]) for key in _JSON}
        names = json.loads(tree.attrs["runs"])
        own = {name.partition("/")[0] for name in names}
        runs = {name: _dataset(tree[name]) for name in names}
        groups = {name: _dataset(node) for name, node in tree.children.items() if name not in own}
        metrics = json.loads((out_dir / METRICS_FILE).read_text("utf-8"))
        companions = json.loads(tree.attrs["companions"])
    except (OSError, ValueError, KeyError) as error:
        raise _unreadable(out_dir, error) from error
    return StudyResults(
        **loaded,
        runs=runs,
        groups=groups,
        reference=tree.attrs["reference"] or None,
        metrics=metrics,
        companions=tuple(read_results(out_dir / name) for name in companions),
    )


def _dataset(node: Any) -> xr.Dataset:
    data: xr.Dataset = node.to_dataset(inherit=False)
    return data


def _unreadable(out_dir: Path, error: Exception) -> InputError:
    missing = isinstance(error, FileNotFoundError)
    why = "a file of them is missing" if missing else "they are damaged, or of another program"
    return InputError(
        f"{out_dir}: cannot be read as results of a study ({why}); run the study again"
    )
