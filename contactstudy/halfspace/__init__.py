"""Elastic half-spaces: Hertz, Love, patches of wheels on rails, stresses below a pressure."""
