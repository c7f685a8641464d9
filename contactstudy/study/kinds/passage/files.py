"""Files of a passage beside those that every study has."""

from pathlib import Path

from contactstudy.study.kinds.passage.fields import write_fields
from contactstudy.study.results import StudyResults


def write_files(results: StudyResults, out_dir: Path) -> list[Path]:
    """Fields for ParaView and the animation of the patch, of the runs that kept some."""
    written = write_fields(results, out_dir)
    if any("frame_pressure" in run.variables for run in results.runs.values()):
        from contactstudy.figures.animation import write_animations

        written += write_animations(results, out_dir)
    return written
