"""Who runs independent tasks: this process, others of this machine, or a cluster; one contract for all of them."""
