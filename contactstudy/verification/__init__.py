"""The engine that runs named cases, each with a reference beside its computed values."""
