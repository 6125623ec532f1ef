"""Which process runs which tests of a parallel run, and in which order.

Most processes begin with the tests that wait for other processes (servers, browsers, FreeCAD), which leave the cores
idle half of the time; one of four with those that compute, at a lower priority, as they fill what is left of the
cores until the end. What is long comes first: the last files decide when the run ends.
"""

from collections import defaultdict, deque
from collections.abc import Iterable
from pathlib import Path

TESTS = Path(__file__).parent
#: of so many processes one begins with what computes
_COMPUTES = 4
#: folders and files whose tests mostly wait for other processes
WAITING = (
    "browser", "clients", "deploy", "docs", "freecad", "jobs", "network", "optimize/test_warm_up.py", "service",
    "studies/accuracy/test_service.py", "test_forks.py",
)  # fmt: skip
#: folders whose files share a server that is long in starting: one process runs all of it
TOGETHER = ("browser", "clients", "freecad")
#: of those, what would end last: from this file on another process runs it, in the order of the names
HALVES = {"browser": "browser/test_paper.py"}
#: what takes longest, the longest first; of the rest that of most tests
LONG = (
    "browser/test_paper.py",
    "browser",
    "freecad",
    "clients",
    "docs/test_guides.py",
    "docs/test_contributing.py",
    "jobs/test_damage.py",
    "jobs/test_history.py",
    "jobs/test_coordinator.py",
    "network/test_attacks.py",
    "network/test_bystander.py",
    "network/test_workers.py",
    "network/test_connections.py",
    "service/test_server.py",
    "network/test_memory.py",
    "jobs/test_kills.py",
    "jobs/test_cli_sweep.py",
    "jobs/test_dask.py",
    "network/test_access.py",
    "network/test_files.py",
    "docs/test_api.py",
    "docs/test_documents.py",
    "network/test_schema.py",
    "network/test_answers.py",
    "network/test_stopped.py",
    "service/test_fuzz.py",
    "service/test_choices.py",
    "service/test_readiness.py",
    "network/test_priorities.py",
    "network/test_cut.py",
    "studies/accuracy/test_service.py",
    "test_forks.py",
    "optimize/test_warm_up.py",
    "docs/test_site.py",
    "pairs/test_pairs.py",
    "verification/test_claims.py",
    "hard_effects/test_hard_effects.py",
    "hard_turn/test_hard_turn.py",
    "verification/test_table.py",
    "benchmarks/test_sweep.py",
    "benchmarks/test_cases.py",
    "studies/accuracy/test_ladder.py",
    "program/test_optima.py",
    "optimize/test_engines.py",
    "hard/test_search.py",
    "dust/test_dust.py",
    "verification/test_cases.py",
    "mutation/test_mutants.py",
    "report_document/test_print.py",
    "optimize/test_choices_along_axes.py",
    "optimize/test_choices_in_order.py",
    "hard/test_battery.py",
    "verification/test_dynamics.py",
    "verification/test_turn.py",
    "studies/pareto/test_choice_trades.py",
    "choices/test_quarters.py",
    "studies/pareto/test_reach.py",
    "report_document/test_pdf.py",
    "numerics/test_shortcuts.py",
    "report_document/test_head.py",
    "choices/test_ample.py",
    "openmdao/test_balance.py",
    "numerics/test_compiling.py",
    "hard/test_boundary.py",
    "studies/sweep/test_chosen_orders.py",
    "studies/matching/test_four_lists.py",
)


class Distribution:
    """Units of work of a parallel run: files, or folders whose files share a server.

    Parameters
    ----------
    names : of all tests, in their order, as pytest gives them: ``tests/folder/test_file.py::test_name``.
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._units: defaultdict[str, deque[int]] = defaultdict(deque)
        for place, name in enumerate(names):
            self._units[_unit(name)].append(place)

    @property
    def waits(self) -> bool:
        """Whether any of the units that are left mostly waits."""
        return any(map(waits, self._units))

    def take(self, waiting: bool) -> deque[int]:
        """Places of the tests of the next unit, of one that waits or of one that computes if it may choose; or none."""
        if not self._units:
            return deque()
        return self._units.pop(min(self._units, key=lambda unit: (waits(unit) != waiting, *self._rank(unit))))

    def _rank(self, unit: str) -> tuple[int, int]:
        place = LONG.index(unit) if unit in LONG else len(LONG)
        return place, -len(self._units[unit])


def _unit(name: str) -> str:
    file = name.split("::", 1)[0].removeprefix("tests/")
    folder = file.split("/", 1)[0]
    if folder not in TOGETHER:
        return file
    half = HALVES.get(folder)
    return half if half is not None and file >= half else folder


def begins_with_what_waits(number: int) -> bool:
    """Whether a process of a run does so, by its number, and not with what computes."""
    return number % _COMPUTES != 1


def divides(name: str) -> bool:
    """Whether tests of the unit of a test may be run by several processes: those that share a server are not."""
    return _unit(name).split("/", 1)[0] not in TOGETHER


def waits(unit: str) -> bool:
    """Whether the tests of a unit mostly wait for other processes."""
    return unit in WAITING or unit.split("/", 1)[0] in WAITING
