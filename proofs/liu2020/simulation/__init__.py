"""The trips of liu2020 in compiled loops: its train, line and disturbances under its laws."""
