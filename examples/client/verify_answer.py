"""What an answer of any kind says of its counterweights, of what they leave, and of how far from the best they are."""

from __future__ import annotations

from math import nan
from typing import Dict, List, NamedTuple, Optional, Tuple

from verify_cases import scenarios
from verify_claims import Claims, near, same
from verify_cranks import balance_rates
from verify_machine import ON_FRAME, Machine, Mass, Responses
from verify_numbers import ABOUT_ONE, COSTS, ONE, SPECK, ZERO, Number, Place, real, total
from verify_orders import first_order, floor, of_order, orders
from verify_quality import quality
from verify_weights import UNSURE, active_limits, counterweights, shafts, usual_gap

MASS_GAP = 1e-4  # largest mass_relative_gap of an optimal answer


class Fitted(NamedTuple):
    """What is chosen or there: what turns with the crankshaft, what with balance shafts by its order, and masses."""

    turning: List[Mass]
    on_shafts: List[Tuple[int, Mass]]
    mass: Number
    on_shafts_mass: Number

    @property
    def first(self) -> List[Mass]:
        """All that turns once, with or against the crankshaft."""
        return [*self.turning, *(mass for order, mass in self.on_shafts if order == 1)]


NOTHING_FITTED = Fitted([], [], ZERO, ZERO)


def fitted(request: Place, machine: Machine, place: Place, on_shafts: Place, whole: bool = True) -> Claims:
    """Counterweights of crankshaft and balance shafts; returns them. ``whole``: whether they have all their fields."""
    turning, mass = yield from counterweights(machine, place, request / "machine" if whole else Place(None))
    turning_there, mass_there = yield from shafts(machine, request / "machine", on_shafts)
    return Fitted(turning, turning_there, mass, mass_there)


def before(request: Place, machine: Machine, answer: Place) -> Claims:
    """The machine as it is: its plane, its first two orders, and what is left of it whatever is fitted."""
    if answer / "reference_plane_m":
        yield near("reference_plane", answer / "reference_plane_m", machine.own_plane * ABOUT_ONE)
    residual = answer / "residual"
    yield from first_order("before", residual / "before", machine.before)
    yield from beside("before", residual / "responses", "before", machine.before)
    if answer / "floor":
        yield from floor(machine, request / "machine", answer / "floor")
    if residual / "orders":
        own = [(1, machine.before), (2, of_order(request, machine, 2))]
        yield from orders("orders", residual / "orders" / "before", own)


def beside(claim: str, place: Place, field: str, responses: Responses) -> Claims:
    """First-order peaks of the responses that count beside force and moment."""
    for entry in place:
        name = (entry / "response").text(*ON_FRAME)
        yield claim, entry / "response", ONE, ONE
        yield near(claim, entry / field, total(map(abs, responses[name])))
        if entry / "unit":
            yield same(claim, entry / "unit", ON_FRAME[name].unit.replace("Nm", "N m"))


def after(request: Place, machine: Machine, answer: Place, there: Fitted) -> Claims:
    """What the counterweights leave."""
    left, residual = machine.responses(there.first), answer / "residual"
    yield from first_order("after", residual / "after", left)
    yield from beside("after", residual / "responses", "after", left)
    if residual / "orders":
        twice = of_order(request, machine, 2, there.on_shafts)
        yield from orders("orders", residual / "orders" / "after", [(1, left), (2, twice)])
    yield near("total_mass", answer / "total_mass_kg", there.mass)
    if answer / "balance_shafts_mass_kg":
        yield near("total_mass", answer / "balance_shafts_mass_kg", there.on_shafts_mass)
    if answer / "balance_rate":
        yield from rates(request / "machine", machine, answer / "counterweights", answer / "balance_rate", there)
    if answer / "balance_quality":
        yield from quality(request / "machine", machine, answer / "balance_quality", there.turning)
    if answer / "active_limits":
        rooms = touched(request, machine, left, there.mass)
        if rooms is not None:
            yield from active_limits("active_limits", answer / "active_limits", rooms)


def rates(design: Place, machine: Machine, place: Place, entries: Place, there: Fitted) -> Claims:
    """The balance rate of every throw."""
    unbalances = {
        (entry / "web").text(): mass.product * (mass.co + machine.blur) for entry, mass in zip(place, there.turning)
    }
    exact, printed = balance_rates(design, machine, unbalances), list(entries)
    yield "balance_rate", entries, ONE if len(exact) == len(printed) else -ONE, ONE
    for entry, rate in zip(printed, exact):
        yield same("balance_rate", entry / "throw", rate.throw)
        yield same("balance_rate", entry / "name", rate.name)
        for field, figure in (("rate", rate.rate), ("sideways", rate.sideways)):
            if figure is None or not entry / field:
                yield "balance_rate", entry, ONE if figure is None and not entry / field else -ONE, ONE
            else:
                yield near("balance_rate", entry / field, figure, ONE)


def touched(request: Place, machine: Machine, left: Responses, mass: Number) -> Optional[Dict[str, float]]:
    """Limits of the machine, and the share of each that is left; None where some are of the turn or of other cases."""
    goal = request / "objective"
    rooms: Dict[str, float] = {}
    if machine.budget is not None:
        rooms["max_total_mass"] = _room(float(mass), float(machine.budget))
    elsewhere = (goal / "orders").value == "all" or scenarios(request) or request / "tolerances"
    for name, response in ON_FRAME.items():
        for axis in ("", "_x", "_y"):
            most = goal / f"{name}_ceiling{axis}_{response.unit}"
            if most and elsewhere:
                return None
            if most:
                co, counter = left[name]
                reflection = counter.conjugate() * (ONE if axis == "_x" else -ONE)
                peak = abs(co + reflection) if axis else abs(co) + abs(counter)
                # a ceiling that the rounding of what cancels comes near to may be listed or not
                unsure = float(peak) + float(ZERO - peak) > UNSURE * most.double()
                rooms[f"{name}_ceiling{axis}"] = nan if unsure else _room(float(peak), most.double())
    over_the_turn = ("bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm")
    return None if any(goal / field for field in over_the_turn) else rooms


def _room(size: float, most: float) -> float:
    return 1 - size / most if most > 0 else 0.0


def gaps(request: Place, answer: Place, mass: Number, is_choice: bool = False) -> Claims:
    """Gaps are the differences of what is printed, over their yardsticks, and `optimal` says that they are small."""
    proof, optimal = answer / "certificate", (answer / "status").text() == "optimal"
    objective, lowest, place = proof / "objective", proof / "lower_bound", proof / "yardstick"
    if objective and lowest and place:
        gap, size = objective.number() - lowest.number(), place.number(least=0)
        noise = SPECK * (abs(objective.number()) + abs(lowest.number()))
        yield near("gap", proof / "gap", gap + noise)
        yield near("relative_gap", proof / "relative_gap", (gap + noise) * ABOUT_ONE / size if size.low > 0 else ZERO)
        wide = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        order = list(request / "objective" / "priorities")
        last = max((n for n, priority in enumerate(order) if (priority / "goal").text() not in COSTS), default=0)
        if last < len(order) - 1:
            # what castings cost is made small within this
            wide = wide + (order[last] / "allowance").number(0.0, least=0)
        if optimal:
            yield "status", answer / "status", wide * size + noise - gap, size
        rest = proof / "objective_without_counterweights"
        if rest and rest.double() > 0 and not is_choice:
            yield near("yardstick", place, rest.number() * ABOUT_ONE)
    elif optimal:
        yield "status", answer / "status", -ONE, ONE
    if not optimal:
        yield "status", answer / "status", ONE, ONE
    least, place = proof / "mass_lower_bound_kg", proof / "mass_yardstick_kg"
    if least and place:
        size, gap = place.number(least=0), mass - least.number()
        noise = SPECK * (mass + abs(least.number()))
        relative = (gap + noise) * ABOUT_ONE / size if size.low > 0 else ZERO
        yield near("mass_gap", proof / "mass_relative_gap", relative)
        if optimal:
            yield "status", answer / "status", size * real(MASS_GAP) + noise - gap, size


def closest(request: Place, machine: Machine, place: Place) -> Claims:
    """The best compromise with ceilings that cannot be kept, which does not keep them either."""
    if not place:
        return
    there = yield from fitted(request, machine, place / "counterweights", place / "balance_shafts")
    left = machine.responses(there.first)
    yield from first_order("closest", place / "first_order", left)
    yield from beside("closest", place / "responses", "peak", left)
