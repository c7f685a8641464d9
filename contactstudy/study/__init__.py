"""From a study file to runs, their comparison and the results on disk."""
