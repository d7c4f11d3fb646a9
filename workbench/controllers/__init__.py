"""Control laws: each paper's in its own file, as sympy expressions."""
