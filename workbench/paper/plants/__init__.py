"""The study of a folder whose plant is any `Plant`: record, runs, Monte Carlo, tuning, and the check of a folder."""
