"""The MPC family: one model, its quadratic programs, and the controllers that are made of them."""
