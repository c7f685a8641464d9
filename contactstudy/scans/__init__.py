"""Scanned rail heads and wheel treads: files to surfaces, their faults, the fitted shapes."""

from contactstudy.scans.cover import uncovered
from contactstudy.scans.meeting import Meeting, meeting
from contactstudy.scans.reading import UNITS, read_mesh
from contactstudy.scans.surface import SurfaceScan, scanned_surface

__all__ = [
    "UNITS",
    "Meeting",
    "SurfaceScan",
    "meeting",
    "read_mesh",
    "scanned_surface",
    "uncovered",
]
