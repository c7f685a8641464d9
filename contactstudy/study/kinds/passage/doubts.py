"""What a passage warns of in the end."""

from contactstudy.figures.measured import fitted
from contactstudy.study.kinds.passage.held_against import reversed_sentences
from contactstudy.study.kinds.passage.report.lost import flown_off
from contactstudy.study.results import StudyResults


def doubts(results: StudyResults) -> list[str]:
    """Wheels that flew off, and gauges that seem to count the other way."""
    return [*flown_off(results), *reversed_sentences(fitted(results))]
