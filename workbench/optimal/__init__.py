"""Energy-optimal references: what a train can do on a line, the best run, and a proven bound on it."""
