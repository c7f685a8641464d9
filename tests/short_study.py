"""A short study of points, for tests of what surrounds the computation."""

WAY = """
[track]
length = "6 m"
[journey]
from = "1.2 m"
to = "3 m"
time_step = "0.2 ms"
fade_in = "0.6 m"
"""
POINT = f"""{WAY}
[irregularity]
terms = 50
[runs.point]
solver = "point"
"""
HERTZ = """[runs.hertz]
solver = "point"
law = "hertz"
"""
"""A run more."""
