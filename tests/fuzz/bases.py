"""Sound inputs of every kind, small: what mutants are made of."""

from pathlib import Path

import numpy as np
import trimesh

from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.synthetic_scan import synthetic_scan

SHORT = """
[track]
length = "12 m"
[journey]
from = "3 m"
to = "9 m"
fade_in = "1 m"
speed = "250 km/h"
"""
POINT = '[runs.point]\nsolver = "point"\nk_r = "1 GN/m"\n'
STUDIES = {
    "plain": f"""title = "Plain"
[irregularity]
seed = 3
terms = 200
band = [0.08, 20.0]
{SHORT}
[vehicle]
wheel_mass = "890 kg"
wheel_radius = "430 mm"
{POINT}""",
    "level": f"""[irregularity]
spectrum = "measured"
file = "level.csv"
level_column = "level"
level_unit = "mm"
wavelengths = ["3 m", "25 m"]
[track]
length = "60 m"
[journey]
from = "26 m"
to = "34 m"
fade_in = "1 m"
{POINT}""",
    "defect": f"""[irregularity]
spectrum = "smooth"
wheel_defect = "depth_map"
wheel_defect_file = "map.csv"
wheel_defect_at = "6 m"
{SHORT}{POINT}""",
    "profiles": """[positions]
wheels = ["right"]
load = "60 kN"
wheel_profile = "wheel.csv"
rail_profile = "rail.csv"
wheel_radius = "460 mm"
""",
    "scan": f"""[solid]
section = "whole"
[vehicle]
wheel_radius = "0.46 m"
[scan]
rail = "rail.stl"
rail_unit = "mm"
wheel = "wheel.ply"
wheel_unit = "mm"
{SHORT}
[runs.surface]
solver = "surface"
""",
}
"""Name of a study -> its file."""
FILES = {
    "plain": (),
    "level": ("level.csv",),
    "defect": ("map.csv",),
    "profiles": ("wheel.csv", "rail.csv"),
    "scan": ("rail.stl", "wheel.ply"),
}
"""Name of a study -> the files that it reads."""


def write_bases(folder: Path) -> None:
    """Write all studies and the files that they read."""
    for name, text in STUDIES.items():
        (folder / f"{name}.toml").write_text(text, "utf-8")
    x = np.arange(0.0, 60.01, 0.25)
    rng = np.random.default_rng(5)
    level = sum(rng.normal() * np.sin(2 * np.pi * x / w + w) for w in (3.5, 6.0, 11.0, 20.0))
    rows = [f"{a:.2f},{0.3 * b:.4f}" for a, b in zip(x, level, strict=True)]
    _lines(folder / "level.csv", ["x,level", *rows])
    depth = [
        f"{s},{y},{0.2 * np.cos(np.pi * s / 60) ** 2:.5f}"
        for s in range(-30, 31, 5)
        for y in range(-40, 41, 20)
    ]
    _lines(folder / "map.csv", ["s,y,depth", *depth])
    for name, curve, ends in (
        ("rail", rail_curve("60E1"), (-0.0455, 0.0455)),
        ("wheel", wheel_curve("S1002"), (-0.0455, 0.05)),
    ):
        points = 1e3 * curve.point(np.arange(*ends, 0.5e-3))
        _lines(folder / f"{name}.csv", ["y [mm],z [mm]", *(f"{y:.4f},{z:.4f}" for y, z in points)])
    for name, curve, length in (
        ("rail.stl", rail_curve("60E1"), 0.04),
        ("wheel.ply", wheel_curve("S1002"), 0.06),
    ):
        mesh = synthetic_scan(curve, length, step=2.5e-3)
        scaled = trimesh.Trimesh(1e3 * np.asarray(mesh.vertices), mesh.faces, process=False)
        scaled.export(folder / name)


def _lines(path: Path, lines: list[str]) -> None:
    path.write_text("\n".join(lines) + "\n", "utf-8")
