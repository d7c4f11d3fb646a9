"""Plots that a reader of a page can zoom into, read values from, and take away as a table."""
