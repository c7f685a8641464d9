"""The solvers: put track, vehicle, irregularity and contact law together, return a dataset."""
