"""Scanned rail heads and wheel treads: files to surfaces, their faults, the fitted shapes."""

from contactstudy.scans.cover import uncovered
from contactstudy.scans.meeting import Meeting, meeting
from contactstudy.scans.reading import UNITS, read_mesh
from contactstudy.scans.scan import Scan, read_scan

__all__ = [
    "UNITS",
    "Meeting",
    "Scan",
    "meeting",
    "read_mesh",
    "read_scan",
    "uncovered",
]
