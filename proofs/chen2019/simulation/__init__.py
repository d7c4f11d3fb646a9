"""The trips of chen2019 in compiled loops: its cars under its law, and under MPC."""
