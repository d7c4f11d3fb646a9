"""A fair fight: the same train, line, sensors, seeds and tuning budget for every controller."""
