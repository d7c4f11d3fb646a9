"""A control paper as one executable object: proof, simulation and comparison from the same expressions."""

__version__ = "0.1.0"
