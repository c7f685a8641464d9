"""Axes: keys of a study of any kind that are varied, refined or drawn at random."""
