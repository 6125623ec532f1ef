"""What is said while the service cannot compute."""

from service.common.problems import FaultTable, later_by_error
from service.watch.readiness import NotReady

FAULTS: FaultTable = {NotReady: later_by_error(503, "Not ready")}
