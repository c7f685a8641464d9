"""How far two results are from each other: norms, bands, convergence, passing components."""
