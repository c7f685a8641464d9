"""How far two results are from each other: norms, bands, refinement, passing components."""
