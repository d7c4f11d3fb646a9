"""A paper's own experiment: what its tables and figures show, run again, printed beside obtained."""
