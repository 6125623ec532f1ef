"""What is said about documents that are not there."""

from service.common.problems import FaultTable, fixed
from service.routes.guide import MissingGuide

FAULTS: FaultTable = {
    MissingGuide: fixed(
        404, "Missing guide", "The guide is not built: run `make docs`, or set COUNTERWEIGHT_GUIDE_DIR."
    )
}
