"""Imported by the process that workers are forked from: loads the optimiser, compiles it and solves a machine once."""

import os
import signal

#: a worker is one of as many as there are cores; read by the libraries when they are imported
for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"
# supervisors send SIGTERM, terminals SIGINT to the whole group, but open requests are to end first;
# these processes end with the service
signal.signal(signal.SIGTERM, signal.SIG_IGN)
signal.signal(signal.SIGINT, signal.SIG_IGN)

#: what went wrong, if anything did
failure: str | None = None
try:
    from pkgutil import resolve_name

    # what is loaded when it is first needed, once for all workers
    import scipy.spatial  # noqa: F401

    from optimizer.warm_up import warm_up
    from service.computations import COMPUTATIONS
    from service.workers import worker  # noqa: F401

    for _one in COMPUTATIONS.values():
        for _needed in (_one.request, _one.compute, *(form.write for form in _one.forms)):
            resolve_name(_needed)
    warm_up()
except Exception:
    import traceback

    failure = traceback.format_exc()
