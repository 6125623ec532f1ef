"""Certified counterweights of many designs of one shape; one request is a batch of one."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.formulation.counterweights import masses_and_angles, unbalance
from optimizer.formulation.goals import cone_program
from optimizer.formulation.task import Demand
from optimizer.mechanics.fixed_weights import fixed_mass
from optimizer.numerics.arrays import Complex, Real, Reals
from optimizer.numerics.records import record
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import Optima, optima
from optimizer.program.methods.symmetry import symmetric
from optimizer.program.points import points_at
from optimizer.program.statement import Statement
from optimizer.program.verdict import INFEASIBLE, Claim, Verdict, claim, verdict
from optimizer.responses.response import Response
from schemas.machine.machine import Machine
from schemas.request.objective import Objective

#: fields of a certificate about the mass
MASS_FIGURES = ("mass_lower_bound_kg", "mass_relative_gap", "mass_yardstick_kg", "mass_objective_limit")


@record(frozen=True)
class Certified:
    """Counterweights of N designs as they are fitted, and what is proven of them."""

    program: Statement  # (N,), over omega^2, with the limits that the proofs count with
    omega_squared: Real  # (N,) rad^2/s^2
    optima: Optima
    mass_kg: Real  # (N, K), of the answer, as all that follows
    angle_deg: Real  # (N, K)
    unbalance: Complex  # (N, K) kg m, of these masses and angles
    certificate: dict[str, np.ndarray]  # (N,) fields of the certificate, in the units of the answer; nan is null
    status: np.ndarray  # (N,)
    reason: np.ndarray  # (N,) a sentence


def certified(
    machine: Machine,
    goal: Objective,
    responses: Sequence[Response],
    omega_squared: Real,
    demand: Demand,
) -> Certified:
    """Counterweights that minimise the objective, or those closest to ceilings that are out of reach.

    Parameters
    ----------
    machine, goal : of columns (N,) or of numbers; the designs have one shape of program.
    omega_squared : (N,) rad^2/s^2.
    """
    program = within_reach(cone_program(machine, goal, responses, omega_squared))
    answer = optima(program, demand.relative_gap, demand.least_mass)
    if goal.symmetric:
        answer = replace(answer, unbalance=symmetric(program, answer.unbalance))
    mass, angle, u, best, claimed, judged = judgement(machine, demand, program, answer)
    certificate = figures(machine, claimed, judged, program.at_rest, best.mass_target, omega_squared)
    certificate["method"] = best.method
    status, reason = judged.status, judged.reason
    if best.unreachable.any():
        status = np.where(best.unreachable, "infeasible", status)
        reason = np.where(best.unreachable, INFEASIBLE, reason)
    return Certified(program, omega_squared, best, mass, angle, u, certificate, status, reason)


class Judgement(NamedTuple):
    """Counterweights of N designs as they are fitted, and what is true of them in the units of their program."""

    mass_kg: Real  # (N, K)
    angle_deg: Real  # (N, K)
    unbalance: Complex  # (N, K) kg m
    optima: Optima  # with the mass proven for all that come to no more than these
    claim: Claim
    verdict: Verdict


def judgement(machine: Machine, demand: Demand, program: Statement, optima: Optima) -> Judgement:
    """What may be claimed of counterweights as they are fitted, whatever the speed.

    Parameters
    ----------
    program : (N,), over omega^2, of the machine.
    """
    mass, angle = masses_and_angles(machine, optima.unbalance, program.limits)
    u = unbalance(mass, angle, program.limits.radius)
    point = points_at(program, u)
    if demand.least_mass:
        optima = optima.counting(program, point.objective)
    mass_bound = optima.mass_lower_bound if demand.least_mass else None
    heavy = np.add.reduce(mass, axis=-1)
    claimed = claim(program, u, heavy, optima.lower_bound, optima.multipliers, mass_bound, point)
    return Judgement(mass, angle, u, optima, claimed, verdict(claimed, demand.relative_gap))


def figures(
    machine: Machine, claimed: Claim, judged: Verdict, at_rest: Reals, mass_target: Reals, omega_squared: Reals
) -> dict[str, np.ndarray]:
    """Fields of certificates (...) in the units of the answer; nan is null.

    Parameters
    ----------
    at_rest, mass_target : objectives without counterweights, and the largest that proofs of the mass count as optima.
    """
    if claimed.mass_lower_bound is None:
        of_mass = dict.fromkeys(MASS_FIGURES, np.full(np.shape(omega_squared), np.nan))
    else:
        least = judged.mass_lower_bound + fixed_mass(machine)
        masses = (least, judged.mass_gap, judged.mass_yardstick, np.asarray(mass_target * omega_squared))
        of_mass = dict(zip(MASS_FIGURES, masses, strict=True))
    return {
        "objective": claimed.value[..., 0] * omega_squared,
        "lower_bound": judged.lower_bound[..., 0] * omega_squared,
        "gap": judged.gap[..., 0] * omega_squared,
        "relative_gap": judged.relative_gap,
        "yardstick": claimed.yardstick[..., 0] * omega_squared,
        "objective_without_counterweights": np.asarray(at_rest * omega_squared),
        **of_mass,
    }
