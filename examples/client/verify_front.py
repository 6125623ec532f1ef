"""Fronts: each point by what is done with one answer."""

from __future__ import annotations

from functools import partial

from verify_answer import MASS_GAP, before, touched
from verify_cases import OF_CASES, OFF, uncertain
from verify_claims import Claim, Claims, covered, near, same
from verify_counts import COUNTED, counted
from verify_cuts import SHAFTS
from verify_first import CEILING, ceilings, infeasible, light, lightest, priced_at, proven, smallest
from verify_form import form
from verify_machine import ENTRY_FIELDS, NAMES, Machine
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, Place, Unreadable, largest, real
from verify_orders import first_order
from verify_program import Statement
from verify_shafts import geared
from verify_trades import TRADED, traded
from verify_turn import looks_at_the_turn, unreachable
from verify_weights import active_limits, counterweights, shafts, usual_gap
from verify_worst_front import of_both, worst_curve

STATUSES = ("optimal", "inaccurate", "infeasible")
STRAIGHT = 1e-4  # a front that lies nearer to the line between its ends has no knee
UNSURE = 1e-9


def front(request: Place, answer: Place) -> Claims:
    """Fronts of force and moment, one for each budget."""
    yield from form(answer, ("pareto",))
    kind = "counts" if request / "counts" else "trades" if list(request / "responses") else "fronts"
    fields = {"counts": COUNTED + TRADED, "trades": TRADED}.get(kind, "")
    request.require_coverage(f"{ENTRY_FIELDS}{SHAFTS}{OFF}{OF_CASES}{fields}")
    design, goal = request / "machine", request / "objective"
    plain = _machine(request, answer, design / "max_total_mass_kg")
    yield from before(request, plain, answer)
    yield from first_order("before", answer / "without_counterweights", plain.before)
    fronts, budgets = list(answer / kind), list(request / "total_mass_budgets_kg")
    if len(fronts) != max(1, len(budgets)):
        raise Unreadable((*answer.path, kind), "must hold one front for each budget")
    worst = max(fronts, key=lambda curve: STATUSES.index((curve / "status").text(*STATUSES)))
    yield same("status", answer / "status", (worst / "status").value)
    for curve, budget in zip(fronts, budgets or [design / "max_total_mass_kg"]):
        if budget:
            yield near("max_total_mass", curve / "max_total_mass_kg", budget.number())
        elif curve / "max_total_mass_kg":
            # nobody asked for one
            yield "max_total_mass", curve / "max_total_mass_kg", -ONE, ONE
        if kind == "counts":
            yield from covered(counted(request, _machine(request, answer, budget), curve))
            continue
        if (curve / "status").text(*STATUSES) == "infeasible":
            yield "status", curve / "status", ONE if curve / "infeasibility" else -ONE, ONE
            of_all = list(design / "balance_shafts") or uncertain(request) or looks_at_the_turn(request)
            no_weights = unreachable if of_all else infeasible
            yield from no_weights(request, answer, budget, curve / "infeasibility")
            continue
        machine = _machine(request, answer, budget)
        if kind == "trades":
            yield from covered(traded(request, machine, curve))
            continue
        if uncertain(request):
            yield from worst_curve(request, machine, curve)
            yield from _closed(request, curve)
            yield from _shape(curve)
            continue
        on_shafts = geared(design, machine, mirrored=True)
        statement = Statement(machine, goal, {name: {name: ONE} for name in NAMES}, geared=on_shafts)
        for name, unit in NAMES.items():
            alone = Statement(machine, goal, {name: {name: ONE}}, geared=on_shafts)
            yield _scale(alone, curve / "scale" / f"{name}_{unit}")
        for entry in curve / "points":
            yield from covered(point(statement, request, curve / "scale", entry))
        yield from _closed(request, curve)
        yield from _shape(curve)
        ends, implied = curve / "ends", curve / "implied_max_mass_kg"
        yield from covered(smallest(machine, goal, ends, ends / "multipliers", implied, on_shafts))


def _shape(curve: Place) -> Claims:
    """The ends are the first and the last point, and the knee is farthest below the line between them."""
    points, ends = list(curve / "points"), curve / "ends"
    worst = max(points, key=lambda point: STATUSES.index((point / "status").text(*STATUSES[:2])), default=curve)
    status, of_points = (curve / "status").value, (worst / "status").value
    # ends that are not closed leave a front open whose points all are closed: that is not looked at
    modest = status == "inaccurate" and of_points == "optimal"
    yield "status", curve / "status", None if modest else ONE if status == of_points else -ONE, ONE
    peaks = [[point / f"weighted_{name}_peak_{unit}" for name, unit in NAMES.items()] for point in points]
    names = (("smallest_force_N", "moment_at_smallest_force_Nm"), ("force_at_smallest_moment_N", "smallest_moment_Nm"))
    for fields, point in zip(names, (peaks[0], peaks[-1])) if peaks else ():
        for field, peak in zip(fields, point):
            yield near("front", ends / field, peak.number() * ABOUT_ONE)
    for first, second in zip(peaks, peaks[1:]):
        # from the smallest force to the smallest moment
        right = first[0].double() <= second[0].double() and first[1].double() > second[1].double()
        yield "front", second[0], ONE if right else -ONE, ONE
    (x, y), (far, low) = (
        ([number.double() for number in point] for point in (peaks[0], peaks[-1])) if peaks else ((0, 0),) * 2
    )
    bent = peaks if len(peaks) > 2 and far > x and y > low else []
    depths = [(y - m.double()) / (y - low) - (f.double() - x) / (far - x) for f, m in bent]
    deepest = max(depths, default=0.0)
    if not curve / "knee":
        yield "front", curve, ONE if deepest <= STRAIGHT * (1 + UNSURE) else -ONE, ONE
    else:
        k = (curve / "knee").double()
        there = depths[int(k)] if k in range(len(depths)) else -1.0
        yield "front", curve / "knee", ONE if there >= deepest - UNSURE and deepest > 0 else -ONE, ONE


def _closed(request: Place, curve: Place) -> Claims:
    """A front is optimal only where both smallest peaks are as near to what is proven of them as its points are."""
    accuracy = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
    for name, unit in NAMES.items() if (curve / "status").value == "optimal" else ():
        smallest, bound = (curve / "ends" / f"smallest_{name}_{end}{unit}" for end in ("", "lower_bound_"))
        peak, size = smallest.number(), (curve / "scale" / f"{name}_{unit}").number()
        # that the end is near to its bound proves nothing of the bound
        yield "status", smallest, accuracy * size + SPECK * peak - (peak - bound.number()), size


def _scale(statement: Statement, place: Place) -> Claim:
    """The peak without counterweights, or where that is next to nothing at most what they could make it."""
    machine, size = statement.machine, place.number()
    (rest,) = statement.values(machine.laden).values()
    most = statement.reachable(Place({}))
    if rest.low > (size * real(1e-6)).high:
        return near("yardstick", place, rest)
    if most is None:
        return "yardstick", place, None, ONE
    # where they make nothing, 1 kg m or 1 kg m^2 that turns with the shaft
    return "yardstick", place, largest(most, machine.square) * ABOUT_ONE - size, size


def _machine(request: Place, answer: Place, budget: Place) -> Machine:
    return Machine(request / "machine", request / "objective", answer / "reference_plane_m", budget)


def point(statement: Statement, request: Place, scale: Place, answer: Place) -> Claims:
    """One point of a front: nobody is below its corner in both weighted peaks."""
    proof, multipliers, status = answer / "certificate", answer / "multipliers", answer / "status"
    implied, place = proof / "implied_max_mass_kg", answer / "counterweights"
    optimal = status.text("optimal", "inaccurate") == "optimal"
    weights, mass = yield from counterweights(statement.machine, place, request / "machine")
    yield near("total_mass", answer / "total_mass_kg", mass)
    if statement.geared or list(answer / "balance_shafts"):
        turning, on_shafts = yield from shafts(statement.machine, request / "machine", answer / "balance_shafts")
        yield near("total_mass", answer / "balance_shafts_mass_kg", on_shafts)
        weights, mass = [*weights, *(weight for order, weight in turning if order == 1)], mass + on_shafts
    yield from ceilings(statement, weights, place, optimal)
    after = statement.machine.responses(weights)
    peaks = statement.values(after)
    relative, worst = proof / "relative_gap", ZERO
    for name, unit in NAMES.items():
        co, counter = after[name]
        yield near("after", answer / f"{name}_peak_{unit}", abs(co) + abs(counter))
        yield near("objective", answer / f"weighted_{name}_peak_{unit}", peaks[name])
        if answer / "worst_case":
            # of what nothing is said to be off
            yield near("worst_case", answer / "worst_case" / f"{name}_peak_{unit}", abs(co) + abs(counter))
        corner, size = proof / f"{name}_{unit}", (scale / f"{name}_{unit}").number()
        yield near("yardstick", proof / "yardstick" / f"{name}_{unit}", size)
        if corner:
            worst = largest(worst, (peaks[name] + SPECK * peaks[name] - corner.number()) * ABOUT_ONE / size)
            # the point is above its corner by no more than it says: that proves nothing of the corner
            above = peaks[name] + SPECK * peaks[name] - corner.number()
            yield "gap", relative, relative.number() * size - above, peaks[name]
    if relative:
        yield near("gap", relative, worst)
    if not optimal:
        yield "status", status, ONE, ONE
    if optimal:
        accuracy = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        yield "status", relative, accuracy - relative.number() if relative else None, ONE
    rooms = touched(request, statement.machine, after, mass)
    if rooms is not None:
        yield from active_limits("active_limits", answer / "active_limits", rooms)
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    priced = partial(priced_at, {name: (proof / f"{name}_{unit}").number(0.0) for name, unit in NAMES.items()})
    of_corner = proven("corner", proof / "force_N", statement, multipliers / "objective", implied, slack, priced)
    yield from of_both(of_corner, proof)
    most = {name: (proof / f"mass_{name}_limit_{unit}").number(0.0) for name, unit in NAMES.items()}
    if proof / "mass_lower_bound_kg":
        yield from lightest(statement, proof, multipliers, most, after, mass)
        sizes = {name: (scale / f"{name}_{unit}").number() for name, unit in NAMES.items()}
        yield from light(statement, proof, sizes, mass)
        size, gap = (proof / "mass_yardstick_kg").number(0.0), mass - (proof / "mass_lower_bound_kg").number()
        yield near("mass_gap", proof / "mass_relative_gap", gap * ABOUT_ONE / size if size.low > 0 else ZERO)
        if optimal:
            yield "status", status, size * real(MASS_GAP) - gap, size
