"""The trips of mao2018 in compiled loops: its train, modes and failed motor under its laws."""
