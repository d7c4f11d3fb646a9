"""Lines and trains as files state them, and the course that a train meets on a line."""
