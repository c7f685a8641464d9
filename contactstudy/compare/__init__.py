"""How far two results are from each other: norms, convergence, components along the rail."""
