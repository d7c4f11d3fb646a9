"""Text in the cells of a CSV file, which spreadsheets open, and run where it looks like a formula."""

from __future__ import annotations

# What a formula begins with, and what is passed over before it.
FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")


def text_cell(text: str) -> str:
    """The text, behind an apostrophe where a spreadsheet would take it for a formula.

    For what comes from somebody's file; numbers are written as they are.
    """
    return f"'{text}" if text.startswith(FORMULA) else text
