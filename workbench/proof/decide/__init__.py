"""Deciders: each proposes certificates of one kind; `engine` puts them in turn."""
