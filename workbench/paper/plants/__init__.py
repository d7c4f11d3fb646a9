"""The study of a folder whose plant is any `Plant`: its record, runs, Monte Carlo, tuning, and the check of a folder."""
