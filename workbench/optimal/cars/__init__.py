"""Trains of several cars: forces shared among them, their own equations simulated along a plan."""
