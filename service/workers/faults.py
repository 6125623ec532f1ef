"""What is said where no worker answers."""

from service.common.problems import FaultTable, fixed, later
from service.workers.pool import TooSlow, WorkerDied
from service.workers.process import WorkersFailed
from service.workers.worker import NoRoom, OutOfMemory

FAULTS: FaultTable = {
    TooSlow: later(503, "Too slow", 5),
    WorkerDied: later(503, "Worker died", 1),
    WorkersFailed: later(503, "Workers failed", 5),
    NoRoom: later(503, "No room", 30),
    OutOfMemory: fixed(422, "Out of memory"),
}
