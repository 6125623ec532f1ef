"""What is said about examples and kinds of problems that are not there."""

from service.common.problems import FaultTable, fixed
from service.documents.examples import UnknownExample
from service.documents.problem_kinds import UnknownProblemKind

FAULTS: FaultTable = {
    UnknownExample: fixed(404, "Unknown example", "There is no example of this name; GET /v1/examples lists them."),
    UnknownProblemKind: fixed(404, "Not Found", "There is no kind of problem of this name."),
}
