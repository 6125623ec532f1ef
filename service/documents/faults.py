"""What is said about examples that are not there."""

from service.documents.examples import UnknownExample
from service.problems import FaultTable, fixed

FAULTS: FaultTable = {
    UnknownExample: fixed(404, "Unknown example", "There is no example of this name; GET /v1/examples lists them."),
}
