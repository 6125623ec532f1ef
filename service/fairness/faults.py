"""What is said to clients who would have more than their share."""

from service.common.problems import FaultTable, later, later_by_error
from service.fairness.table import BUSY, NO_ROOM, OVER_SHARE


class TooManyConnections(Exception):
    """As many connections as are allowed are open; a retry may help."""

    def __init__(self) -> None:
        super().__init__("No more connections may be open, of this address or altogether; try again later.")


class Busy(Exception):
    """As many requests as are allowed are waiting; a retry helps after ``retry_after_s``."""

    def __init__(self, waiting: int, retry_after_s: int) -> None:
        self.retry_after_s = retry_after_s
        super().__init__(f"{waiting} requests are waiting already; try again later.")


class OverShare(Exception):
    """The client holds as much as it may; a retry helps when it has let go of something."""


FAULTS: FaultTable = {
    TooManyConnections: later(*NO_ROOM, 1),
    Busy: later_by_error(*BUSY),
    OverShare: later(*OVER_SHARE, 1),
}
