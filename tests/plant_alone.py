"""A plant's compiled rates, without a loop."""

# --- kernel ---
