"""What is said about jobs that are not there, not done, or too many, and about where they are kept."""

from service.common.problems import Fault, FaultTable, fixed, later
from service.jobs.database import DatabaseUnavailable
from service.jobs.files import FilesUnavailable
from service.jobs.owner_jobs import NotFinished, RowsDamaged
from service.jobs.results import UnknownColumn
from service.jobs.rows import UnknownJob
from service.jobs.schema import WrongSchema
from service.jobs.store import KeyReused, QuotaExceeded, TooManyJobs
from service.jobs.worksheet import TooLargeForWorksheet


def _not_finished(error: NotFinished) -> Fault:
    return Fault(409, "Not finished", str(error), headers={"Retry-After": "1"} if error.retry else {})


def _database(error: DatabaseUnavailable) -> Fault:
    # its address and its user are for the log
    words = "has no room left" if error.full else "is locked, or does not answer"
    return Fault(
        503, "Database unavailable", f"The job database {words}; try again later.", headers={"Retry-After": "5"}
    )


FAULTS: FaultTable = {
    UnknownJob: fixed(404, "Unknown sweep", "There is no sweep of this id, or its results have expired."),
    KeyReused: fixed(409, "Key reused"),
    NotFinished: _not_finished,
    UnknownColumn: fixed(422, "Unknown column"),
    TooLargeForWorksheet: fixed(422, "Too large for a worksheet"),
    TooManyJobs: later(429, "Too many jobs", 30),
    QuotaExceeded: fixed(409, "Quota exceeded"),
    DatabaseUnavailable: _database,
    WrongSchema: fixed(503, "Wrong schema"),
    FilesUnavailable: later(503, "Files unavailable", 5),
    RowsDamaged: later(503, "Rows damaged", 2),
}
