"""The trials of jiao2025 in compiled loops: its train under its laws, and under MPC."""
