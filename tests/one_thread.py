"""One thread for each test process: libraries read it when they are imported, and two processes have two cores."""

import os

for limit in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(limit, "1")
