"""A paper's LaTeX source as rows: its numbered equations, assumptions and theorems in order, and its letters."""
