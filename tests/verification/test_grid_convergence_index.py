"""Observed order and grid convergence index against two published worked examples."""

import pytest

from contactstudy.compare.convergence import grid_convergence, observed_order
from contactstudy.exceptions import InputError, NumericalError


def test_nasa_example():
    """NASA Glenn, "Examining spatial (grid) convergence": total pressure recovery, r = 2."""
    result = grid_convergence([0.97050, 0.96854, 0.96178], [1.0, 2.0, 4.0])
    print(f"order        1.78617   {result.order:.5f}")
    print(f"extrapolated 0.97130   {result.extrapolated:.5f}")
    print(f"GCI          0.1031 %  {100 * result.index:.4f} %")
    assert result.order == pytest.approx(1.78617, abs=5e-6)
    assert result.extrapolated == pytest.approx(0.97130, abs=1e-5)
    assert 100 * result.index == pytest.approx(0.1031, abs=5e-5)


def test_celik_example():
    """Celik et al. 2008, table 1, first column: unequal ratios 1.5 and 1.333.

    Table 1 states 18000, 8000 and 4500 cells, so sizes go with N^(-1/2).
    """
    sizes = [cells**-0.5 for cells in (18000, 8000, 4500)]
    result = grid_convergence([6.063, 5.972, 5.863], sizes)
    print(f"order        1.534   {result.order:.4f}")
    print(f"extrapolated 6.1685  {result.extrapolated:.4f}")
    print(f"GCI          2.17 %  {100 * result.index:.3f} %")
    assert result.order == pytest.approx(1.534, abs=1e-3)
    assert result.extrapolated == pytest.approx(6.1685, abs=1e-4)
    assert 100 * result.index == pytest.approx(2.17, abs=0.01)


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0, 4.0])
def test_order_of_a_manufactured_series(p):
    sizes = (0.1, 0.17, 0.31)
    values = [3.0 - 2.0 * h**p for h in sizes]
    result = grid_convergence(values, sizes)
    assert result.order == pytest.approx(p, rel=1e-9)
    assert result.extrapolated == pytest.approx(3.0, rel=1e-9)


def test_what_cannot_have_an_order():
    with pytest.raises(NumericalError, match="monotonically"):
        observed_order([1.0, 1.1, 1.05], [1, 2, 4])
    with pytest.raises(InputError, match="increase"):
        observed_order([1.0, 1.1, 1.3], [4, 2, 1])
    with pytest.raises(InputError, match="three values"):
        observed_order([1.0, 1.1], [1, 2])
