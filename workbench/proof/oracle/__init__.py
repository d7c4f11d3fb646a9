"""A second opinion on verdicts by an SMT solver: no verdict rests on it, and one that it contradicts is told."""
