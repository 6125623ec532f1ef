"""Ceilings that conflict in several scenarios: those of which, and what proves it of these alone."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.cuts.proof import Proof
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.optimum import optimum
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.solve.proof import Speeds, excess_multipliers
from schemas.answer.proof import BoundMultipliers, ScenarioConflict

#: share of the largest multiplier of a conflict from which on a ceiling takes part in it
TAKES_PART = 1e-6


class ProvenConflict(NamedTuple):
    """What proves that ceilings conflict, the scenarios whose ceilings do, and where several do so by themselves what
    proves that of each."""

    multipliers: BoundMultipliers
    scenarios: tuple[str, ...]
    alone: tuple[ScenarioConflict, ...]


def proven_conflict(program: Problem, failure: Conflict, speeds: Speeds) -> ProvenConflict:
    """Scenarios whose ceilings are out of reach by themselves, or those whose ceilings conflict with one another.

    Parameters
    ----------
    program : under all ceilings.
    speeds : omega^2 of all scenarios, rad^2/s^2.
    """
    proof, names = failure.proof, _participants(failure.proof, TAKES_PART)
    alone = []
    for name in names if len(names) > 1 else ():
        under, result = _under(program, name)
        if isinstance(result, Conflict) and _holds(result.proof, failure.limits):
            alone.append(ScenarioConflict(scenario=name, conflict=_printed(under, result.proof, speeds)))
    if len(alone) == 1:
        return ProvenConflict(alone[0].conflict, (alone[0].scenario,), ())
    if alone:
        return ProvenConflict(_printed(program, proof, speeds), tuple(entry.scenario for entry in alone), tuple(alone))
    if names:
        part = _only(proof, names)
        # what takes part in it next to nothing may be what a narrow proof needs
        proof, names = (part, names) if _holds(part, failure.limits) else (proof, _participants(proof, 0.0))
    return ProvenConflict(_printed(program, proof, speeds), names, ())


def _printed(program: Problem, proof: Proof, speeds: Speeds) -> BoundMultipliers:
    return excess_multipliers(proof.with_pieces, proof.multipliers, program.excess_scales(proof.cuts), speeds)


def _participants(proof: Proof, share: float) -> tuple[str, ...]:
    """Scenarios whose ceilings have more than a share of all multipliers."""
    statement, row = proof.statement, np.maximum(proof.multipliers.row, 0.0)
    leant = row[statement.row] > share * np.sum(row)
    terms = zip(statement.names.terms, leant.tolist(), strict=True)
    return tuple(dict.fromkeys(term.scenario for term, counts in terms if counts and term.scenario is not None))


def _only(proof: Proof, names: tuple[str, ...]) -> Proof:
    """The proof by the ceilings of some scenarios."""
    statement, multipliers = proof.statement, proof.multipliers
    of_term = np.array([term.scenario in names for term in statement.names.terms])
    of_row = np.zeros(multipliers.row.shape, dtype=bool)
    # all terms of a row are of one scenario
    of_row[statement.row] = of_term
    rest = replace(multipliers, term=multipliers.term * of_term, row=multipliers.row * of_row)
    return replace(proof, multipliers=rest)


def _holds(proof: Proof, limits: Limits) -> bool:
    """Whether multipliers prove an excess within limits."""
    statement = replace(proof.with_pieces, limits=limits)
    return bool(objective_lower_bound(statement, proof.multipliers) > CEILING_ROUNDING)


def _under(program: Problem, scenario: str) -> tuple[Problem, CertifiedOptimum | Conflict]:
    """The program under the ceilings of one scenario alone, as far as whether they can be kept."""
    ceilings = tuple(ceiling for ceiling in program.ceilings if ceiling[0].scenario == scenario)
    limited = tuple(pair for pair in program.limited if program.quantities[pair[0]].scenario == scenario)
    under = program.changed(goals=program.goals[-1:], ceilings=ceilings, limited=limited)
    return under, optimum(under, 1.0, False)
