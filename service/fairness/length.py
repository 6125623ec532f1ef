"""Which computations are long: those that may take more than two seconds of a core.

Long ones have turns of their own, behind all others, so that no number of them keeps a short one waiting. What is long
is decided in three steps. A kind may be long, as its entry says, before it has any turn. A size may be, in the worker
that has read the request. And whatever computes for longer than that is long, however it looked before.

Short ones that are not quick are computed behind all that may be quick.
"""

from schemas.base.model import Model
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.report import ReportRequest
from schemas.request.scene import Scene

#: what computes for longer is long [s]
BRIEF_S = 2.0
#: what computes for longer is behind all that has computed for less [s]
QUICK_S = 0.1
#: a document on a machine of so many webs, rows or bearings takes a second, one on twice as many 1.6
_DOCUMENT = 50
#: so many values of one output over a turn take a second, five times as many are the most that is legal
_VALUES = 40_000


def long_by_size(request: Model, document: bool) -> bool:
    """Whether a request is too large for a short answer; the answer may be a document."""
    if not isinstance(request, Scene):
        return False
    if document:
        return _parts(request) > _DOCUMENT
    sampled = any(output != "residual" for output in request.outputs)
    return sampled and _rows_or_bearings(request.machine) * request.angles.count > _VALUES


def _parts(request: Scene) -> int:
    """Webs, rows or bearings, whichever are most, of all machines in a document."""
    versions = request.versions if isinstance(request, ReportRequest) else ()
    machines = (request.machine, *(version.machine or request.machine for version in versions))
    return max(sum(len(machine.webs) for machine in machines), sum(_rows_or_bearings(machine) for machine in machines))


def _rows_or_bearings(machine: Machine) -> int:
    if not isinstance(machine, ReciprocatingMachine):
        return 1
    return max(sum(len(throw.rows) for throw in machine.throws), len(machine.bearings))
