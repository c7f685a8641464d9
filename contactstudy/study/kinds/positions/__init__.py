"""A wheelset pressed on its rails at given positions."""
