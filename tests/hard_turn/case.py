"""A hard case of a program over the turn: a machine, an objective and what is hard about it."""

import copy
from typing import Any, NamedTuple

from tests.hard_turn.machines import Body

#: nothing but what is named counts
ALONE = {"force_weight": 0, "moment_weight": 0}


BEARINGS = {**ALONE, "bearing_weight": 1}


BENDING = {**ALONE, "bending_weight": 1}


class Case(NamedTuple):
    """One request.

    expected : "optimal", "infeasible", or "said": on an edge or beyond what doubles hold, any status that is explained.
    """

    name: str
    why: str
    body: Body
    expected: str = "optimal"

    @property
    def theme(self) -> str:
        return self.name.partition("/")[0]


def case(
    name: str,
    why: str,
    machine: Body,
    objective: Body,
    *,
    expected: str = "optimal",
    shaft: str = "simple_spans",
    gap: float | None = None,
) -> Case:
    body: Body = {
        "machine": machine,
        "objective": objective,
        "fidelity": {"shaft": shaft},
        "angles": {"step_deg": 30},
    }
    if gap is not None:
        body["accuracy"] = {"relative_gap": gap}
    return Case(name, why, body, expected)


def every(body: Body, place: str, **fields: Any) -> Body:
    """The machine with fields of all webs, bearings or throws replaced."""
    changed = copy.deepcopy(body)
    for variant in changed[place]:
        variant.update(copy.deepcopy(fields))
    return changed


def variant(body: Body, place: str, index: int, **fields: Any) -> Body:
    changed = copy.deepcopy(body)
    changed[place][index].update(fields)
    return changed
