"""Imported by the process that workers are forked from: loads what most answers need, and solves a machine once.

What few requests need is loaded by their worker. The modelling layer, workbooks, pages and studies take longer than all
else together, and a service would be ready so much later.
"""

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
    from importlib.util import find_spec
    from pkgutil import resolve_name

    from optimizer.warm_up import warm_up
    from service.computations.table import COMPUTATIONS
    from service.workers import worker  # noqa: F401

    for _computation in COMPUTATIONS.values():
        resolve_name(_computation.request)
    for _needed in ("optimize", "analyze"):
        resolve_name(COMPUTATIONS[_needed].compute)
    if find_spec("cvxpy") is None:
        raise ModuleNotFoundError("what few programs need is not installed: cvxpy")
    warm_up()
except Exception:
    import traceback

    failure = traceback.format_exc()
