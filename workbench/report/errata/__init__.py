"""Errata: a paper's corrections as a document that its authors and editors can read, in several formats."""
