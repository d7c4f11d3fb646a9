"""Closed loops: the compiled one, iterative and Monte Carlo runs around it."""
