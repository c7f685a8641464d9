"""Observed order and grid convergence index against published worked examples."""

import pytest

from contactstudy.compare.refinement import convergence


def test_nasa_example():
    """NASA Glenn, "Examining spatial (grid) convergence": total pressure recovery, r = 2."""
    result = convergence([1.0, 2.0, 4.0], [0.97050, 0.96854, 0.96178])
    print(f"order        1.78617   {result.order:.5f}")
    print(f"extrapolated 0.97130   {result.limit:.5f}")
    print(f"GCI          0.1031 %  {100 * result.index:.4f} %")
    assert result.order == pytest.approx(1.78617, abs=5e-6)
    assert result.limit == pytest.approx(0.97130, abs=1e-5)
    assert 100 * result.index == pytest.approx(0.1031, abs=5e-5)


@pytest.mark.parametrize(
    "cells, values, order, limit, index",
    [
        ((18000, 8000, 4500), (6.063, 5.972, 5.863), 1.534, 6.1685, 2.17),
        ((18000, 4500, 980), (10.7880, 10.7250, 10.6050), 0.75, 10.8801, 1.1),
    ],
)
def test_celik_examples(cells, values, order, limit, index):
    """Celik et al. 2008, table 1, first two columns: unequal ratios; sizes go with N^(-1/2)."""
    result = convergence([n**-0.5 for n in cells], values)
    print(f"order        {order}   {result.order:.4f}")
    print(f"extrapolated {limit}  {result.limit:.4f}")
    print(f"GCI          {index} %  {100 * result.index:.3f} %")
    assert result.order == pytest.approx(order, abs=2e-3 if order > 1 else 5e-3)
    assert result.limit == pytest.approx(limit, abs=1e-4 if order > 1 else 1e-3)
    assert 100 * result.index == pytest.approx(index, abs=0.01 if order > 1 else 0.05)
