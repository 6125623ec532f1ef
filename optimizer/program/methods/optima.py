"""The way in: optima of many programs of one shape, each as if it were alone; one program is a batch of one.

All are solved side by side by the compiled interior point; what it does not certify goes down the cascade one by one.
"""

import time
from dataclasses import fields, replace
from operator import attrgetter
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Real, all_true, any_true
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers, mass_bound_up_to, nothing_proven
from optimizer.program.equal_unknowns import apart, united
from optimizer.program.methods.cascade import cascade
from optimizer.program.methods.compiled import StageSolutions, stage_solutions, suits_kernel
from optimizer.program.methods.empty_webs import leave_empty
from optimizer.program.methods.feasibility_phase import smallest_excesses
from optimizer.program.methods.inactive_rows import settle_without_slack_rows
from optimizer.program.methods.single import Target, interior_point, only
from optimizer.program.points import points_at
from optimizer.program.solution import (
    CEILING_ROUNDING,
    CLOSED_FORM,
    CONE_PROGRAM,
    INTERIOR_POINT,
    OPTIMUM_SHARE,
    ConeSolution,
    Solutions,
    side_by_side,
)
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick

#: what optima have of solutions, before what they have of their own
_OF_SOLUTIONS = attrgetter(*(field.name for field in fields(Solutions)))
_NO_PROGRAM = np.zeros(0, int)
#: of what is compiled: without webs, and with some
_METHODS = (np.array([CLOSED_FORM], dtype=object), np.array([INTERIOR_POINT], dtype=object))


@record(frozen=True)
class Optima(Solutions):
    """Counterweights of N programs; of an unreachable one those that come closest to its ceilings."""

    unreachable: np.ndarray  # (N,) bool: proven that no counterweights keep the ceilings
    method: np.ndarray  # (N,) str
    conflict: Multipliers  # (N, ...), those of the excess over the ceilings where they are unreachable, 0 elsewhere

    def counting(self, statement: Statement, objective: Real) -> "Optima":
        """With the mass proven for all that come to no more than what is returned (N,). A limit that was counted with
        may be below that, and then proves nothing."""
        more = np.maximum(objective - self.mass_target, 0.0)
        if not more.any():
            return self
        price = self.mass_multipliers.admissible(statement).price(statement)
        bound = mass_bound_up_to(self.mass_lower_bound, price, more)
        return replace(self, mass_lower_bound=bound, mass_target=np.maximum(self.mass_target, objective))

    def single(self, n: int = 0) -> ConeSolution:
        """One of them."""
        return ConeSolution(
            self.unbalance[n],
            float(self.objective[n]),
            float(self.lower_bound[n]),
            float(self.mass[n]),
            float(self.mass_lower_bound[n]),
            float(self.excess[n]),
            self.multipliers.subset(n),
            str(self.method[n]),
            float(self.certify_s[n]),
            self.mass_multipliers.subset(n),
            float(self.mass_target[n]),
            self.conflict.subset(n) if self.unreachable[n] else None,
        )


def optima(statement: Statement, relative_gap: float, least_mass: bool, until: float = np.inf) -> Optima:
    """Certified optima of N statements of one shape, one leading axis (N,); each as if it were alone.

    Parameters
    ----------
    statement : programs whose limits are finite (:func:`optimizer.program.methods.implied_bounds.within_reach`).
    relative_gap : target gap, relative to the objective without counterweights.
    least_mass : take the least total mass among the optima.
    until : time.thread_time() after which the methods that have begun are the last.
    """
    alike = statement.limits.alike
    if alike is not None and alike.plain:
        # no proof says otherwise: the terms are the same, and so are the multipliers
        answer = optima(united(statement, alike), relative_gap, least_mass, until)
        return replace(answer, unbalance=apart(answer.unbalance, alike))
    if not statement.reaches.idle:
        return _optima(statement, relative_gap, least_mass, until)
    carries = statement.limits.reach > 0
    # webs that cannot carry anything are left out of their programs
    patterns, inverse = np.unique(carries, axis=0, return_inverse=True)
    parts, places = [], []
    for k, webs in enumerate(patterns):
        programs = np.flatnonzero(inverse.reshape(-1) == k)
        part = _optima(statement.subset(programs).only(webs), relative_gap, least_mass, until)
        everywhere = np.zeros((programs.size, webs.size), complex)
        everywhere[:, webs] = part.unbalance
        parts.append(replace(part, unbalance=everywhere))
        places.append(programs)
    return side_by_side(parts, np.argsort(np.concatenate(places)))


def _optima(statement: Statement, relative_gap: float, least_mass: bool, until: float) -> Optima:
    """Of programs whose webs can all carry something."""
    size = yardstick(statement)
    share, demand = min(OPTIMUM_SHARE, relative_gap) * size, relative_gap * size
    stages = stage_solutions(statement, share, demand, least_mass) if suits_kernel(statement) else None
    if stages is not None and time.thread_time() < until:
        settle_without_slack_rows(statement, share, demand, least_mass, stages)
    answer = _nothing(statement) if stages is None else _compiled(statement, stages)
    left = np.arange(size.size) if stages is None else _uncertified(stages)
    if stages is not None and left.size and statement.ceilings.names:
        left = _without_unreachable(statement, answer, left)
    for n in left.tolist():
        program, target = statement.subset(n), Target(float(share[n]), float(demand[n]), least_mass, until)
        quick = (
            interior_point(program, target) if stages is None else only(program, target, stages.subset(np.array([n])))
        )
        _put(answer, n, cascade(program, target, quick))
    unreachable = answer.unreachable if any_true(answer.unreachable) else None
    leave_empty(statement, answer, share, least_mass, unreachable, until)
    return answer


def _uncertified(stages: StageSolutions) -> np.ndarray:
    """Programs that both stages left open; mostly none."""
    certified = stages.certified
    return _NO_PROGRAM if all_true(certified) else np.flatnonzero(~certified)


def _without_unreachable(statement: Statement, answer: Optima, programs: np.ndarray) -> np.ndarray:
    """Some programs without those whose ceilings are proven to be out of reach, which are answered, all at once.

    As :func:`optimizer.program.methods.cascade.cascade` answers one of them.
    """
    part = statement.subset(programs)
    nearest = smallest_excesses(part)
    over = nearest.lower_bound > CEILING_ROUNDING
    proven, at, points = nearest.subset(over), programs[over], points_at(part, nearest.smallest).subset(over)
    answer.unbalance[at], answer.objective[at], answer.mass[at] = points.unbalance, points.objective, points.mass
    answer.excess[at], answer.lower_bound[at], answer.mass_lower_bound[at] = points.excess, -np.inf, 0.0
    answer.multipliers.put(at, nothing_proven(part.subset(over)))
    answer.mass_target[at], answer.certify_s[at] = np.inf, proven.certify_s
    answer.unreachable[at], answer.method[at], answer.clean[at] = True, CONE_PROGRAM, False
    answer.conflict.put(at, proven.multipliers)
    return programs[~over]


def _compiled(statement: Statement, solutions: Solutions) -> Optima:
    """Optima of the compiled interior point."""
    programs = solutions.objective.shape
    method = _METHODS[bool(statement.limits.radius.shape[-1])].repeat(solutions.objective.size)
    own = np.zeros(programs, bool), method, _no_conflict(statement)
    every: tuple[Any, ...] = (*_OF_SOLUTIONS(solutions), *own)
    return Optima(*every)


def _no_conflict(statement: Statement) -> Multipliers:
    shape = statement.ceilings.cap.shape
    return Multipliers(np.zeros(shape, complex), np.zeros(shape), np.zeros((*shape[:-1], 0), complex))


def _nothing(statement: Statement) -> Optima:
    """No point and no proof."""
    webs = statement.limits.radius.shape
    endless = np.full(webs[:-1], np.inf)
    return Optima(
        unbalance=np.zeros(webs, complex),
        objective=endless,
        lower_bound=-endless,
        mass=endless.copy(),
        mass_lower_bound=np.zeros(webs[:-1]),
        excess=endless.copy(),
        multipliers=nothing_proven(statement),
        mass_multipliers=nothing_proven(statement),
        mass_target=endless.copy(),
        certify_s=np.zeros(webs[:-1]),
        clean=np.zeros(webs[:-1], bool),
        unreachable=np.zeros(webs[:-1], bool),
        method=np.full(webs[:-1], CONE_PROGRAM, dtype=object),
        conflict=_no_conflict(statement),
    )


def _put(answer: Optima, n: int, solution: ConeSolution) -> None:
    answer.unreachable[n], answer.clean[n] = solution.conflict is not None, False
    for field in fields(ConeSolution):
        value = getattr(solution, field.name)
        if isinstance(value, Multipliers):
            getattr(answer, field.name).put(n, value)
        elif value is not None:
            getattr(answer, field.name)[n] = value
