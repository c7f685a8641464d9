"""Linear systems in time: matrices, integrators, the stepper, the static start, energy."""
