"""The only place where expressions become code: numba kernels, casadi functions."""
