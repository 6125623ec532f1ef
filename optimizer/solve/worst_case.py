"""Certified counterweights of any mass, of the unchanged machine or in the worst case of several, and what the worst
case costs."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from optimizer.formulation.balance_shafts import Fitted, placement_of
from optimizer.formulation.counterweights import unbalance
from optimizer.formulation.formulate import active_responses, extra_responses, of_all_orders
from optimizer.formulation.goals import Goals, bearing_responses, formulate
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.brackets import Brackets
from optimizer.program.cuts.cut import Quantity
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.optimum import optimum
from optimizer.responses.curve import TurnResponse
from optimizer.solve.answer_fields import bound_beside, fitted
from optimizer.solve.cut_plates import cut_plates, implied_masses
from optimizer.solve.infeasibility import out_of_reach
from optimizer.solve.solution import Infeasible, Solution, finite_or_null, multipliers_of
from optimizer.solve.uncertain_program import MachineOfCase, Measure, Robust
from schemas.answer.first_order import ResponsePeak
from schemas.answer.robust import PriceOfRobustness, WorstCase, WorstPeaks
from schemas.request.scene import Fidelity

#: width of brackets of what is shown, relative; and of those that tell which of several peaks may be the largest
_CLOSE, _ABOUT = 1e-10, 1e-2
_NO_PROOF: Mapping[str, object] = {}
_NO_PRICE = " The time limit ended before the nominal optimum of price_of_robustness was found."


def best_of_any_mass(
    task: Task, scene: Prepared, in_full: bool = True, worst_case: bool = True
) -> Solution | Infeasible:
    """Counterweights of any mass that are optimal, in the worst of all cases where there are several.

    Parameters
    ----------
    in_full : with prices of the limits and what misplaced counterweights may cost.
    worst_case : with what the worst case costs.

    Raises
    ------
    MissingInput
        if a machine lacks what the objective needs.
    """
    robust = Robust(task, scene, task.demand)
    goals, result = robust.solved()
    if isinstance(result, Conflict):
        return out_of_reach(task, scene, goals, result)
    solution = fitted(task, scene, goals, result, robust.demand, in_full)
    return _beside_nominal(robust, goals, solution) if task.robust and worst_case else solution


def _beside_nominal(robust: Robust, goals: Goals, solution: Solution) -> Solution:
    """The same with the worst case, and its cost beside the optimum of the unchanged machine."""
    task, scene = robust.task, robust.scene
    best, late = _nominal_optimum(robust)
    if best is None:
        return with_worst_case(robust, solution, None, late)
    implied = implied_masses(task.space.machine, best.limits)
    # of the masses that are printed, like every figure
    task, scene, goals, mass, angle = cut_plates(task, scene, goals, best.point.unbalance, best.limits)
    if goals.program.plates is not None:
        best = best.within(goals.program.limits)
    u = unbalance(mass, angle, best.limits.radius)
    placement = placement_of(task.machine, task.objective, mass, angle)
    return with_worst_case(robust, solution, u, late, _proof_of(robust, best, placement, u, implied))


def _proof_of(
    robust: Robust, best: CertifiedOptimum, placement: Fitted, u: Complex, implied: Mapping[str, float]
) -> dict[str, object]:
    """The best counterweights (K,) kg m of the unchanged machine, and the proof if there is one goal.

    Parameters
    ----------
    implied : masses that the proof counts with, kg by web.
    """
    fields: dict[str, object] = {
        "nominal_counterweights": placement.counterweights,
        "nominal_balance_shafts": placement.balance_shafts,
    }
    if len(best.goals) > 1:
        return fields
    square, program = robust.scene.omega_squared, nominal(robust).program
    excess = program.values(u, _CLOSE).excess if program.ceilings or program.limited else 0.0
    return fields | {
        "nominal_lower_bound": finite_or_null(bound_beside(best.proof, excess) * square),
        "nominal_multipliers": multipliers_of(best.proof, square, {None: square}),
        "nominal_implied_max_mass_kg": implied,
    }


def with_worst_case(
    robust: Robust, solution: Solution, best: Complex | None, late: bool, proof: Mapping[str, object] = _NO_PROOF
) -> Solution:
    """The solution with the cost of the worst case.

    Parameters
    ----------
    best : (K,) kg m, the best counterweights of the unchanged machine, if any.
    late : the limit of time left them open.
    proof : fields of the price that prove the nominal optimum.
    """
    u = solution.unbalance
    price = PriceOfRobustness.model_validate({**_price(robust, u, best), **proof})
    worst = {"worst_case": _worst_case(robust, u, solution.certificate.objective), "price_of_robustness": price}
    return replace(
        solution, reason=f"{solution.reason}{_NO_PRICE if late else ''}", fields={**solution.fields, **worst}
    )


def nothing_off(task: Task, scene: Prepared, u: Complex, objective: float) -> dict[str, object]:
    """The same fields where tolerances are stated and all are 0: the worst case is what counterweights (K,) come to."""
    return {
        "worst_case": _worst_case(Robust(task, scene, task.demand), u, objective),
        "price_of_robustness": PriceOfRobustness(
            nominal=objective, nominal_optimum=objective, nominal_optimum_worst_case=objective
        ),
    }


def worst_peaks(robust: Robust, u: Complex) -> WorstPeaks:
    """Peaks of force and moment in the worst case, each by itself, with counterweights (K,) kg m."""
    peaks = _peaks(robust, u)
    return WorstPeaks(force_peak_N=peaks["force"], moment_peak_Nm=peaks["moment"])


def _peaks(robust: Robust, u: Complex) -> dict[str, float]:
    """Of every response on the frame that counts."""
    return {
        response.name: max(_external(robust, machine, k, u) for machine in robust.machines)
        for k, response in enumerate(active_responses(robust.task.objective))
    }


def _worst_case(robust: Robust, u: Complex, objective: float) -> WorstCase:
    """Peaks in the worst case, each by itself, with counterweights (K,) kg m."""
    peaks = _peaks(robust, u)
    bearings = robust.machines if robust.task.objective.of_the_shaft else []
    loads = [_peak(robust, machine, list(_bearing_responses(machine, robust.task.fidelity)), u) for machine in bearings]
    return WorstCase(
        force_peak_N=peaks["force"],
        moment_peak_Nm=peaks["moment"],
        responses=tuple(
            ResponsePeak(
                response=response.name, label=response.fields.label, unit=response.unit, peak=peaks[response.name]
            )
            for response in extra_responses(robust.task.objective)
        ),
        bearing_peak_N=max(loads) if loads else None,
        objective=objective,
    )


def _external(robust: Robust, machine: MachineOfCase, response: int, u: Complex) -> float:
    """A peak on the frame: of the first order, or of all where these count."""
    if robust.task.objective.orders == "all":
        every = of_all_orders(machine.turn, machine.scene.laden, robust.task.objective)
        return _peak(robust, machine, every[response : response + 1], u)
    measure, nominal = Measure(response, 1.0, 1.0), machine.nominal[response]
    off = robust.scatter.of(nominal.influence, u)
    if nominal.counter_influence is not None:
        off += robust.scatter.of(nominal.counter_influence, u)
    return (float(np.max(machine.sizes(measure, machine.corners(measure), u))) + off) * machine.scene.omega_squared


def _peak(robust: Robust, machine: MachineOfCase, responses: Sequence[TurnResponse], u: Complex) -> float:
    """The largest of the peaks of several responses: closely of those alone that may have it."""
    masses = machine.share if machine.scatters else 0.0
    quantities = [Quantity(response, "peak", machine.scenario, masses) for response in responses]
    most = np.inf
    for width in (_ABOUT, _CLOSE):
        no = [False] * len(quantities)
        brackets = Brackets(quantities, no, robust.scatter).evaluate(u, np.full(len(quantities), width))
        least = max(bracket.lower for bracket in brackets)
        # a narrow bracket that is not reached may be wider than one that was
        most = min(most, max(bracket.upper for bracket in brackets))
        quantities = [
            quantity for quantity, bracket in zip(quantities, brackets, strict=True) if bracket.upper >= least
        ]
    return float(most) * machine.scene.omega_squared


def _bearing_responses(machine: MachineOfCase, fidelity: Fidelity) -> Iterator[TurnResponse]:
    yield from bearing_responses(machine.space.machine, fidelity, machine.turn, machine.scene.laden)


def _nominal_optimum(robust: Robust) -> tuple[CertifiedOptimum | None, bool]:
    """The best counterweights of the unchanged machine, if any keep its ceilings; whether the limit of time,
    of which the search has what is left, leaves that open."""
    plain, demand, left = nominal(robust), robust.demand, robust.left_s
    if left == 0.0:
        return None, True
    result = optimum(plain.program, demand.relative_gap, demand.least_mass, left)
    if isinstance(result, Conflict) or result.timed_out:
        return None, isinstance(result, CertifiedOptimum)
    # what is neither kept nor proven to be out of reach is no optimum
    return result if result.point.values.excess <= CEILING_TOLERANCE else None, False


def _price(robust: Robust, u: Complex, best: Complex | None) -> dict[str, float | None]:
    """What the worst case costs nominally, and the best of the unchanged machine in the worst case."""
    program, square = nominal(robust).program, robust.scene.omega_squared
    return {
        "nominal": float(program.values(u, _CLOSE).goals[-1]) * square,
        "nominal_optimum": None if best is None else float(program.values(best, _CLOSE).goals[-1]) * square,
        "nominal_optimum_worst_case": None if best is None else _objective(robust, best),
    }


def nominal(robust: Robust) -> Goals:
    """The program of the unchanged machine, with nothing off."""
    task, scene = robust.task, robust.scene
    case = MachineOfCase(task.space, scene, None, 1.0, 0.0).case()
    return formulate(*task.space, [case], scene.omega_squared, task.fidelity)


def _objective(robust: Robust, u: Complex) -> float:
    """The last goal in the worst case, with any counterweights."""
    robust.learnt(u)
    return float(robust.goals().program.values(u, _CLOSE).goals[-1]) * robust.scene.omega_squared
