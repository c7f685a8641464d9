"""Models for other programs: the static press as a CalculiX input file."""
