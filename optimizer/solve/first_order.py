"""Certified counterweights of one request that asks for the first order of the machine as it is given."""

import time
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from optimizer.formulation.balance_shafts import Fitted, chosen, posed
from optimizer.formulation.formulate import given_ceilings, limited, smallest_peak
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.fixed_weights import beside
from optimizer.mechanics.shapes import plates
from optimizer.numerics.arrays import Real, mapped
from optimizer.program.certificate import Multipliers, objective_lower_bound
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import Optima, optima
from optimizer.program.reference.solver import Solver
from optimizer.program.sensitivity import shadow_prices
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from optimizer.solve.certify import Certified
from optimizer.solve.design import certified_one
from optimizer.solve.infeasibility import Smallest, StatedCeiling, report
from optimizer.solve.outcome import Outcome, certificate
from optimizer.solve.prices import shadow_prices as priced
from optimizer.solve.prices import touched_limits
from optimizer.solve.proof import implied_max_mass, named, named_proofs, physical, physical_proofs
from optimizer.solve.sensitivity import of_first_order
from schemas.answer.limits import ShadowPrice
from schemas.answer.proof import Multipliers as PrintedMultipliers
from schemas.request.requests import OptimizeRequest


def certified_first(request: OptimizeRequest, scene: Prepared, solver: Solver) -> Outcome:
    """Counterweights of the smallest objective of the first order, however they may be chosen."""
    asked, square = posed(request), np.array([scene.omega_squared])
    asked, best = certified_one(asked, scene.responses, square, solver)
    cut = None
    if plates(request.machine) is not None:
        # of what is cut from a plate the radius follows; no balance shafts stand beside plates
        request, cut = asked, replace(scene, request=asked)
    began, unreachable = time.perf_counter(), bool(best.status[0] == "infeasible")
    shown = chosen(request, best.mass_kg[0], best.angle_deg[0], best.unbalance[0])
    there = replace(cut or scene, shafts=shown.on_shafts)
    fields = _infeasible(asked, there, best, shown, solver) if unreachable else _reached(asked, there, best, shown)
    return Outcome(
        str(best.status[0]),
        str(best.reason[0]),
        None if unreachable else shown.on_crank,
        None if unreachable else best.unbalance[0],
        shown.on_shafts,
        float(best.found.certify_s[0]),
        str(best.certificate["method"][0]),
        int(best.certificate["nodes"][0]) if "nodes" in best.certificate else 0,
        fields,
        cut,
        time.perf_counter() - began,
    )


def _reached(request: OptimizeRequest, scene: Prepared, best: Certified, fitted: Fitted) -> dict[str, object]:
    """Counterweights, what holds them up, and their certificate."""
    machine, goal, u = request.machine, request.objective, best.unbalance[0]
    mass, _ = beside(machine, best.mass_kg[0], best.angle_deg[0])
    touched = touched_limits(machine, goal, scene.responses, mass, u, scene.omega_squared)
    in_units = physical_proofs(best.program, best.found, best.omega_squared)
    (proofs,) = named_proofs(
        best.program, best.found, in_units, best.omega_squared, goal.least_mass and not best.searched
    )
    figures = {name: column.item(0) for name, column in best.certificate.items()}
    gap, prices = float(best.verdict.gap[0, 0]), tuple[ShadowPrice, ...]()
    if not (np.isnan(gap) or best.searched or machine.web_groups):
        # what limits cost those of any mass says nothing of what can be chosen, nor does one web of a group give way
        proof, at_rest = in_units.objective, float(best.program.at_rest[0])
        every = shadow_prices(best.program, best.unbalance, Multipliers(proof.term, proof.row, proof.ceiling))
        alone = mapped(every, lambda array: array[0])
        prices = priced(machine, goal, alone, (), fitted.active_limits(touched), scene.omega_squared, gap, at_rest)
    return {
        **fitted.fields,
        "active_limits": touched,
        "shadow_prices": prices,
        "sensitivity": of_first_order(best.program, best.unbalance, scene.omega_squared),
        "certificate": certificate(
            figures,
            machine,
            best.program.limits.max_mass[0],
            PrintedMultipliers(objective=proofs.objective, mass=proofs.mass),
        ),
    }


def _conflict(
    request: OptimizeRequest, best: Certified, most: Real, alone: Mapping[str, Optima], solver: Solver
) -> tuple[Statement, Optima] | None:
    """The program and the proof that its ceilings conflict, whatever the limits ``most`` (1, K) let the webs carry.

    None where that is proven for less only.

    Parameters
    ----------
    alone : the smallest peak of each response by itself under these limits. Where a ceiling is below it, what proves it
        proves the conflict as well.
    """
    program = replace(best.program, limits=replace(best.program.limits, max_mass=most))
    excess = program.excess()
    by_one = (_of_one_ceiling(excess, n, alone[name].multipliers) for n, name in enumerate(program.ceilings.names))
    for proof in (best.found.conflict, *by_one):
        if (objective_lower_bound(excess, proof) > CEILING_ROUNDING).all():
            return program, replace(best.found, conflict=proof)
    found = optima(program, request.accuracy.relative_gap, False, solver)
    return (program, found) if found.unreachable.all() else None


def _of_one_ceiling(excess: Statement, ceiling: int, peak: Multipliers) -> Multipliers:
    """The proof of a smallest peak (1, ...) as one of the smallest excess: all on the row of its own ceiling."""
    only = (np.arange(excess.row.size) == ceiling).astype(float)[None]
    return Multipliers(peak.term * only, peak.row * only, np.zeros_like(excess.ceilings.norms.constant))


def _infeasible(
    request: OptimizeRequest, scene: Prepared, best: Certified, fitted: Fitted, solver: Solver
) -> dict[str, object]:
    """Which ceilings conflict, and what can be reached: each peak by itself, and the best compromise."""
    machine, square, given = request.machine, best.omega_squared, given_ceilings(request.objective)
    components = {ceiling.response for ceiling, _ in given} - {each.name for each in scene.responses}
    alone_too = [each for each, _ in limited(scene.responses, request.objective) if each.name in components]
    peaks = {each.name: smallest_peak(each.spread(square.shape), machine) for each in (*scene.responses, *alone_too)}

    def by_itself(most: Real) -> dict[str, tuple[Statement, Optima]]:
        within = {
            name: replace(each, limits=replace(best.program.limits, max_mass=most)) for name, each in peaks.items()
        }
        return {name: (each, optima(each, 1e-9, False, solver)) for name, each in within.items()}

    # one reach for all that is proven here
    reached = (best.program, *(within_reach(peak, solver) for peak in peaks.values()))
    most = np.maximum.reduce([each.limits.max_mass for each in reached], axis=0)
    alone, against = by_itself(most), None
    if best.found.unreachable[0]:
        of_excess = _conflict(request, best, most, {name: found for name, (_, found) in alone.items()}, solver)
        if of_excess is None:
            # of the reach that the conflict is proven for, if peaks by themselves could need a larger one
            most, of_excess = best.program.limits.max_mass, (best.program, best.found)
            alone = by_itself(most)
        in_units = physical_proofs(*of_excess, square)
        (proof,) = named_proofs(*of_excess, in_units, square, request.objective.least_mass)
        against = proof.conflict
    smallest = {
        name: Smallest(
            float(found.objective[0] * square[0]),
            float(found.lower_bound[0] * square[0]),
            named(peak, physical(peak, found.multipliers, "objective", square).chosen(0)),
        )
        for name, (peak, found) in alone.items()
    }
    ceilings = [StatedCeiling(each.response, each.field, allowed) for each, allowed in given]
    return report(scene, fitted, ceilings, ceilings, smallest, implied_max_mass(machine, most)[0], against)
