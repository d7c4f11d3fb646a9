"""Claims, deciders, certificates, and the checker that re-checks them on its own."""
