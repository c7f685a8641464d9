"""Commands that list what there is: shipped studies, keys, what is cached."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter


def studies() -> None:
    """List the shipped studies."""
    import tomllib

    from contactstudy.study.loading import shipped_studies

    shipped = shipped_studies()
    width = max(map(len, shipped), default=0)
    for name, path in shipped.items():
        title = tomllib.loads(path.read_text("utf-8")).get("title", "")
        print(f"{name:<{width}}  {title}")


def vehicles() -> None:
    """List the shipped cars of trains: axle load, models that their source allows, and title."""
    from contactstudy.given_files import toml_file
    from contactstudy.vehicle import GRAVITY
    from contactstudy.vehicle.vehicle_file import read_car, shipped_cars

    shipped = shipped_cars()
    width = max(map(len, shipped), default=0)
    for name, path in shipped.items():
        car = read_car(name)
        models = "planar" if car.missing else "planar, three_dimensional"
        load = f"{car.static_axle_load / GRAVITY / 1e3:.1f} t"
        print(f"{name:<{width}}  {load:>6}  {models:<25}  {toml_file(path).get('name', '')}")


def keys() -> None:
    """Print every key of study files with unit, default, limits and meaning, in Markdown."""
    from contactstudy.study.keys import AXES, key_reference
    from contactstudy.study.kind import KINDS, find_kind

    for name in KINDS:
        kind = find_kind(name)
        inner = {f"{group}.NAME": table for group, table in kind.inner_tables.items()}
        print(f"# {name.capitalize()}\n\n{kind.about}\n")
        print(key_reference({**kind.tables, **inner}, kind.study))
        for title, tables in kind.file_tables.items():
            print(f"# {title}\n\n{key_reference(tables)}")
    print(AXES, end="")


def cache(
    *, clear: Annotated[bool, Parameter(negative="", help="Remove all of them.")] = False
) -> None:
    """Say where condensed bodies, and runs from Python, are kept, how many, and how large."""
    from contactstudy.solids.cache import cache_directory, cache_store
    from contactstudy.store import Store
    from contactstudy.study.results import RUNS

    runs = Store(cache_directory() / RUNS)
    for store in (cache_store(), runs) if runs.folder.is_dir() else (cache_store(),):
        if clear:
            store.clear()
        print(store.summary())
