"""Any plant and any law, as expressions: what the prover, the simulation and MPC are made from."""
