"""Any plant under any law: the compiled loop, a library's solver for stiff plants, what a run is measured by."""
