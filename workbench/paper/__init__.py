"""A paper's folder: what it has, its study, its tuning, its gains."""
