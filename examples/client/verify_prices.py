"""What limits cost, by the multipliers of the bound, and what the objective rises by where weights are off."""

from __future__ import annotations

from cmath import phase, rect
from math import cos, pi, radians, sin
from typing import Dict, Iterator, List, NamedTuple, Sequence, Tuple

from verify_answer import Fitted
from verify_claims import Claims
from verify_machine import ON_FRAME, Machine, Mass
from verify_numbers import ONE, ZERO, NotCovered, Place, real
from verify_program import CEILINGS, Statement, weighed

FIGURE = 1e-9  # share of a figure in doubles, of all that it is made of
WORTH = 1e-6  # share of the objective without counterweights: what a whole limit has to be worth to be listed
PRICED = 1e-4  # share of it by which the bound may be less with the price of a budget beside plates
ACROSS = 1e-3  # rad: by which what pulls at a web may be off a right angle to the edge of its sector
UNITS = {"max_mass": "kg", "max_total_mass": "kg", "envelope": "(kg m)", "max_centrifugal_force": "N", "sector": "deg"}


# ---- where weights are off


def sensitivity(statement: Statement, turning: Sequence[Mass], entry: Place) -> Claims:
    """What the objective rises by where all counterweights are off together, each whichever way is worst."""
    if not entry:
        return
    machine, rounding = statement.machine, 0.0
    webs = [mass for mass, web in zip(turning, machine.webs) if web.fixed is None]
    sums: Dict[str, List[float]] = {row: [float(floor)] * 3 for row, floor in statement.floor.items()}
    for term in statement.terms.values():
        arms = [machine.arm(term.moves, mass.position) for mass in webs]
        vectors = [
            (mass.product * mass.co * arm * term.factor * machine.square).middle() for mass, arm in zip(webs, arms)
        ]
        start = term.start.middle()
        worst = worst_by_angle(start, vectors, radians(1)), worst_by_mass(start, vectors, 0.01)
        sums[term.row] = [size + more for size, more in zip(sums[term.row], (abs(start + sum(vectors)), *worst))]
        # where what is there cancels, its rounding is that of what cancels
        rounding += 1e-14 * (abs(start) + sum(map(abs, vectors))) + 10.0 * float(abs(term.start - term.start))
    as_it_is, by_angle, by_mass = (max(row[k] for row in sums.values()) for k in range(3))
    for field, worse in (("objective_rise_per_deg", by_angle), ("objective_rise_per_percent", by_mass)):
        figure, place = max(worse - as_it_is, 0.0), entry / field
        off = FIGURE * (as_it_is + worse) + rounding if place else -1.0
        yield "sensitivity", place, real(off - abs(place.double(0.0) - figure)), real(abs(figure) + off)


def worst_by_mass(start: complex, vectors: Sequence[complex], share: float) -> float:
    """Largest |start + sum of (1 + e) v|, |e| up to a share: the corners of a zonotope, in the order of their edges."""
    ahead = sorted((v if (v.imag, v.real) >= (0.0, 0.0) else -v for v in vectors), key=phase)
    middle, corner = start + sum(vectors), sum(ahead)
    lengths = [abs(middle + share * corner), abs(middle - share * corner)]
    for v in ahead:
        corner -= 2 * v
        lengths += [abs(middle + share * corner), abs(middle - share * corner)]
    return max(lengths)


def worst_by_angle(start: complex, vectors: Sequence[complex], angle: float) -> float:
    """Largest |start + sum of v e^{j psi}|, |psi| up to an angle.

    Along a direction phi every v is worth |v| cos(max(|phi - arg v| - angle, 0)); between the directions at which these
    change their form the sum is a sine and a constant.
    """
    there = [(abs(v), phase(v)) for v in vectors if v]
    edges = sorted({(way + off) % (2 * pi) for _, way in there for off in (-angle, angle, pi)}) or [0.0]
    length = abs(start + sum(vectors))
    for low, high in zip(edges, [*edges[1:], edges[0] + 2 * pi]):
        middle = (low + high) / 2
        constant, vector = 0.0, start
        for size, way in there:
            off = (middle - way + pi) % (2 * pi) - pi
            if abs(off) <= angle:
                constant += size
            else:
                vector += rect(size, way + (angle if off > 0 else -angle))
        best = low + min(max((phase(vector) - middle + pi) % (2 * pi) - pi + (middle - low), 0.0), high - low)
        for way in (low, high, best):
            length = max(length, constant + (vector * complex(cos(way), -sin(way))).real)
    return length


# ---- what limits cost


class Priced(NamedTuple):
    """A limit that is stated, what a unit of it is worth, how large it is, its unit, and whether it is touched."""

    limit: str
    web: str
    price: float
    size: float
    unit: str
    touched: bool
    edge: bool = False  # whether rounding tells if it costs anything


def prices(statement: Statement, request: Place, answer: Place, there: Fitted, is_choice: bool) -> Claims:
    """The slope of the bound at the limits: none of choices and of groups, where one web does not give way alone."""
    place, goal, proof = answer / "shadow_prices", request / "objective", answer / "certificate"
    machine, gap = statement.machine, proof / "gap"
    entries = list(place)
    if is_choice or machine.groups or not gap:
        yield "shadow_prices", place, -ONE if entries else ONE, ONE
        return
    # of the first response that is weighed
    weights = ((float(weight), ON_FRAME[name].unit) for name, weight in weighed(goal, machine).items())
    weight, unit = next((pair for pair in weights if pair[0] > 0), (0.0, "N"))
    unit = unit.replace("Nm", "N m")
    multipliers = proof / "multipliers" / "objective"
    if machine.budget is not None and any(web.plate for web in machine.webs):
        # the bound was proven by a price found here: that which is printed has to prove it too
        lowest, implied = proof / "lower_bound", proof / "implied_max_mass_kg"
        least = statement.bound(multipliers, implied, {}, ZERO, True, printed=True).least
        noise = real(PRICED) * abs((proof / "objective_without_counterweights").number(0.0))
        yield "shadow_prices", place, None if least is None else least + noise - lowest.number(), abs(lowest.number())
    touched = {(entry.text()) for entry in answer / "active_limits"}
    slopes, ceilings = slope(statement, multipliers)
    arms = [1 + abs((web.position - machine.plane).middle()) for web in machine.webs]
    # of a plate a kilogram metre has the price
    levers = [1.0 if web.plate else abs(web.radius.middle()) for web in machine.webs]
    widest = max((lever * arm for lever, arm in zip(levers, arms)), default=0.0)
    lengths = (abs(complex((entry / "x").double(), (entry / "y").double())) for entry in multipliers / "terms")
    factor = max((abs(term.factor.middle()) for term in statement.terms.values()), default=0.0)
    dust = 1e-11 * widest * machine.square.middle().real * (sum(lengths) * factor + sum(ceilings.values()))
    stated = list(stated_limits(machine, answer / "counterweights", slopes, multipliers, "max_total_mass" in touched))
    for name, length in ceilings.items():
        field = CEILINGS[name]
        limit = field.rpartition("_")[0]
        per = "N" if field.endswith("_N") else "(N m)"
        stated.append(Priced(limit, "", length, (goal / field).double(), per, limit in touched))
    rest = (proof / "objective_without_counterweights").double(0.0)
    yield from price_entries(place, stated, weight, unit, gap.double(), rest, dust)


def price_entries(
    place: Place, stated: Sequence[Priced], weight: float, unit: str, gap: float, rest: float, dust: float
) -> Claims:
    """Prices of what is touched, or holds the objective up, each once, and 0 where the gap is worth more.

    ``dust``: of a price, what rounding leaves where what pulls at a web cancels.
    """
    by_name = {(entry.limit, entry.web): entry for entry in stated}
    names = [((entry / "limit").text(), (entry / "web").text() if entry / "web" else "") for entry in place]
    least = WORTH * rest * (1 + 1e-6) + 1e-200
    # of a limit beyond any need rounding alone is worth a lot
    worth = {key: (entry.price - dust) * entry.size for key, entry in by_name.items()}
    counts = {key: entry.touched or (worth[key] > least and not entry.edge) for key, entry in by_name.items()}
    must = {key for key, entry in counts.items() if entry}
    right = len({*names}) == len(names) and must <= {*names} <= {*by_name}
    yield "shadow_prices", place, ONE if right else -ONE, ONE
    for entry, key in zip(place, names):
        yield "shadow_prices", entry / "limit", ONE if key in by_name else -ONE, ONE
        yield "shadow_prices", entry / "web", ONE, ONE
        if key not in by_name:
            continue
        exact = by_name[key]
        yield "shadow_prices", entry / "unit", ONE if (entry / "unit").value == f"{unit}/{exact.unit}" else -ONE, ONE
        value, price = exact.price / weight, (entry / "value").double(least=0)
        whole = exact.price * exact.size
        # a whole limit that is worth less than the gap has no price that can be told
        by_rounding = 1e-9 * rest / weight / exact.size if exact.size > 1e-300 else 0.0
        near_it = abs(price - value) <= 1e-6 * value + dust / weight + by_rounding
        holds = near_it if price > 0 else exact.size > 0 and whole <= gap * (1 + 1e-3) + 1e-12 * rest
        holds = holds or (price == 0 and (exact.edge or value <= 1e-12 * (rest / weight) + dust / weight))
        yield "shadow_prices", entry / "value", ONE if holds else -ONE, ONE


def slope(statement: Statement, proof: Place) -> Tuple[List[complex], Dict[str, float]]:
    """What the bound falls by per kg m on each web, and the lengths of the multipliers of ceilings."""
    machine, slopes = statement.machine, dict.fromkeys(ON_FRAME, 0j)
    lengths: Dict[str, float] = dict.fromkeys(statement.caps, 0.0)
    for item in proof / "terms":
        key = (item / "response").text(), (item / "part").text("co", "counter")
        if key not in statement.terms or item / "angle_deg" or item / "scenario":
            raise NotCovered(item)
        term, y = statement.terms[key], complex((item / "x").double(), (item / "y").double())
        slopes[term.moves] += y * term.factor.middle()
    for item in proof / "ceilings":
        name, y = (item / "response").text(), complex((item / "x").double(), (item / "y").double())
        if name not in lengths or item / "angle_deg" or item / "scenario":
            raise NotCovered(item)
        slopes[name.partition(":")[0]] += y
        lengths[name] += abs(y)
    square = machine.square.middle().real
    sums = [sum(by * machine.arm(name, web.position).middle().real for name, by in slopes.items())
            for web in machine.webs]  # fmt: skip
    return [-item * square for item in sums], lengths


def stated_limits(
    machine: Machine, fitted: Place, pulls: Sequence[complex], proof: Place, budget_touched: bool
) -> Iterator[Priced]:
    """Every limit of webs and of the total mass."""
    beta = (proof / "budget").double(0.0, least=0)
    for web, place, pull in zip(machine.webs, fitted, pulls):
        if web.fixed is not None:
            continue
        names = {limit.text() for limit in place / "active_limits"}
        plate, sizes = web.plate, {name: float(most) for name, most in web.limits}
        radius = (place / "radius_m").double() if plate else web.radius.middle().real
        worth = max(radius * _support(pull, web.sector) - beta, 0.0)
        if plate is not None:
            # of what one more kilogram metre is worth, its mass takes the price of the budget
            worth = max(_support(pull, web.sector) - beta / plate.lever(plate.most), 0.0)
            sizes["envelope"] = plate.unbalance(plate.most)
        least = min(sizes.values(), default=0.0)
        for name, most in sizes.items():
            binds = worth if most <= least * (1 + 1e-12) else 0.0
            per = 1.0
            if plate is not None and len(sizes) > 1:
                raise NotCovered(place)
            if name == "max_centrifugal_force" and web.pull is not None:
                per = float(web.pull)
            yield Priced(name, web.name, binds / per, most * per, UNITS[name], name in names)
        if web.sector is not None:
            centre, half = web.sector
            off = abs((phase(pull) - radians(centre) + pi) % (2 * pi) - pi) - radians(half)
            u = (place / "mass_kg").double() * radius
            # across the edge a web between its limits gains nothing, on either side of 0
            opening = abs(pull) * sin(off) if 0 < off < pi / 2 + ACROSS else 0.0
            edge = abs(off - pi / 2) < ACROSS
            yield Priced("sector", web.name, radians(u * opening), half, "deg", "sector" in names, edge)
    if machine.budget is not None:
        yield Priced("max_total_mass", "", beta, machine.budget.middle().real, "kg", budget_touched)


def _support(pull: complex, sector: object) -> float:
    if not isinstance(sector, tuple):
        return abs(pull)
    off = max(abs((phase(pull) - radians(sector[0]) + pi) % (2 * pi) - pi) - radians(sector[1]), 0.0)
    return abs(pull) * max(cos(off), 0.0)
