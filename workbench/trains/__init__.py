"""The train as a plant: Davis resistance, grade, curve, tunnel, couplers, lines, and what a run of it is made of."""
