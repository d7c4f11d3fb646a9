"""Control laws as co-simulation units of FMI 3.0, for whoever simulates elsewhere."""
