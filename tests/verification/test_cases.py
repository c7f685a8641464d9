"""Every registered verification case, as `contactstudy verify` runs it."""

import pytest

from contactstudy.verification.cases import CASES
from contactstudy.verification.check import check_lines


@pytest.mark.parametrize(
    "case",
    [pytest.param(c, id=c.name, marks=[pytest.mark.slow] if c.slow else []) for c in CASES],
)
def test_all_checks_are_within_their_bands(case):
    if missing := case.missing():
        pytest.skip(f"needs {' and '.join(missing)}")
    result = case.load()()
    print(f"\n{result.title}\n{check_lines(result.checks)}")
    assert result.name == case.name
    assert result.checks
    assert not [check.quantity for check in result.failed]
