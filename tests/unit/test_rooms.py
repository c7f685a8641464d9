"""Data flow one way: a room imports only from rooms above it (the table in CONTRIBUTING.md)."""

import ast
from pathlib import Path

import contactstudy

PACKAGE = Path(contactstudy.__file__).parent
# from top to bottom; modules of one line may import each other
ORDER = (
    ("__init__",),
    ("exceptions",),
    (
        "arrays",
        "validation",
        "units",
        "csv_rows",
        "resources",
        "files",
        "given_files",
        "texts",
        "version",
        "code",
        "compiled",
        "process",
        "provenance",
        "store",
        "reporter",
    ),
    ("executor", "waiting", "workers", "cluster", "carried"),
    ("profiles",),
    ("irregularity",),
    ("dynamics",),
    ("solids",),
    ("track",),
    ("vehicle",),
    ("geometry", "halfspace"),
    ("scans",),
    ("contact",),
    ("solvers",),
    ("export",),
    ("compare",),
    ("plot",),
    ("study",),
    ("verification",),
    ("figures",),
    ("report",),
    ("study/kinds",),
    ("driver", "notebook"),
    ("advice",),
    ("verification/cases",),
    ("commands",),
    ("cli", "__main__"),
)
LEVEL = {room: level for level, rooms in enumerate(ORDER) for room in rooms}
# folders that are rooms of their own below the room they lie in
INNER = {("study", "kinds"): "study/kinds", ("verification", "cases"): "verification/cases"}


def room_of(parts):
    """Room of a module given by its parts below the package."""
    return INNER.get(tuple(parts[:2]), parts[0])


def imported_rooms(path):
    """Rooms that a file imports from, also within functions."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        for name in names:
            parts = name.split(".")
            if parts[0] == "contactstudy":
                known = len(parts) > 1 and parts[1] in LEVEL
                yield room_of(parts[1:]) if known else "__init__"


def test_every_room_has_its_place():
    rooms = {path.stem for path in PACKAGE.iterdir() if path.suffix == ".py"}
    rooms |= {path.parent.name for path in PACKAGE.glob("*/__init__.py")} | set(INNER.values())
    assert rooms <= set(LEVEL)


def test_rooms_import_only_from_rooms_above():
    wrong = []
    for path in sorted(PACKAGE.rglob("*.py")):
        name = path.relative_to(PACKAGE).as_posix()
        own = room_of(name.removesuffix(".py").split("/"))
        for room in imported_rooms(path):
            if LEVEL[room] > LEVEL[own]:
                wrong.append(f"{name} imports from {room}")
    assert sorted(set(wrong)) == []


def test_the_guide_names_the_rooms_in_this_order():
    guide = Path(__file__).parents[2] / "CONTRIBUTING.md"
    text = guide.read_text("utf-8")
    table = text[text.index("| where |") : text.index("Outside the package")]
    rows = [line.split("|")[1] for line in table.splitlines()[2:] if line.startswith("|")]
    named = [cell.strip("` /").removesuffix(".py") for row in rows for cell in row.split(",")]
    levels = [LEVEL[name] for name in named]
    assert levels == sorted(levels)
    assert set(named) == set(LEVEL) - {"__init__", "__main__"}
