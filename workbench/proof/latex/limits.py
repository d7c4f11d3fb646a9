"""How much a line may hold: every line is read, or refused, within a moment."""

from __future__ import annotations

LONGEST_LINE = 4000  # characters
DEEPEST_NESTING = 30  # brackets, braces and arguments within one another
LONGEST_NUMBER = 30  # digits
LARGEST_EXPONENT = 1000  # of a power whose exponent is a number
MOST_TERMS = 20_000  # of an expression multiplied out, when two are compared
MOST_SUMMANDS = 100  # of a sum with both ends given as numbers
