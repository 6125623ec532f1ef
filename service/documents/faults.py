"""What is said about examples that are not there."""

from service.common.problems import FaultTable, fixed
from service.documents.examples import UnknownExample

FAULTS: FaultTable = {
    UnknownExample: fixed(404, "Unknown example", "There is no example of this name; GET /v1/examples lists them."),
}
