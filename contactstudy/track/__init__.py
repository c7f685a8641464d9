"""The track: what it is (model) and its discretisations (beam, solid)."""
