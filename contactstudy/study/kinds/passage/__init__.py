"""Wheels run over a track."""
