"""Numbers and verdicts as figures, formulas and one self-contained page."""
