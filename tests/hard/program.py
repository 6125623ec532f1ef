"""A machine's program in 100-digit numbers, from the definitions of docs/mathematics.md alone.

Shares no code with the package: the request is read as the dictionary that was posted.
"""

from dataclasses import dataclass
from typing import Any

from tests.hard.interior import ONE, ZERO, Number, mp

Body = dict[str, Any]

#: rounding of an input or of one operation in double precision
EPS = mp.mpf(2) ** -52
#: lengths and unbalances up to here count as 0, as in the package: nothing real is that small
NOTHING = mp.mpf(10) ** -250


def unit(angle_deg: float) -> Any:
    """e^{j angle}, exact for multiples of 90 degrees."""
    half_turns = mp.mpf(angle_deg) / 180
    return mp.mpc(mp.cospi(half_turns), mp.sinpi(half_turns))


@dataclass(frozen=True)
class Web:
    """A place for a counterweight."""

    arm: Number  # from the reference plane, m
    radius: Number  # m
    max_mass: Number  # kg
    centre: Any = ONE  # unit vector
    cosine: Number | None = None  # of the half-angle; None without a sector
    sine: Number = ONE

    def support(self, g: Any) -> Number:
        """Largest Re(conj(g) v) over unit vectors v in the sector and 0."""
        if self.cosine is None:
            return abs(g)
        turned = g * mp.conj(self.centre)
        across = abs(turned.imag)
        if across * self.cosine <= turned.real * self.sine:
            return abs(g)
        return max(ZERO, turned.real * self.cosine + across * self.sine)


@dataclass(frozen=True)
class Pair:
    """Force and moment phasors: co-rotating and counter-rotating, kg m and kg m^2."""

    force: tuple[Any, Any]
    moment: tuple[Any, Any]


@dataclass(frozen=True)
class Machine:
    """Everything that the program depends on."""

    baseline: Pair
    webs: tuple[Web, ...]
    budget: Number | None
    omega_squared: Number
    span: Number  # m, of throws and webs; 1 where that is zero, or nothing that a double could divide by
    noise: tuple[Number, Number]  # rounding that the inputs of force and moment carry in double precision

    def after(self, u: list[Any]) -> Pair:
        """Phasors with counterweights."""
        force, moment = self.baseline.force, self.baseline.moment
        f = force[0] + sum(u, mp.mpc(0))
        m = moment[0] + sum((web.arm * v for web, v in zip(self.webs, u, strict=True)), mp.mpc(0))
        return Pair((f, force[1]), (m, moment[1]))


def machine(body: Body) -> Machine:
    """The machine of a request."""
    data = body["machine"]
    masses, planes = _scroll(data) if data["kind"] == "scroll" else _reciprocating(data)
    axial = list(planes)
    if data["kind"] == "scroll":
        axial.append(mp.mpf(data["anti_rotation"]["position_m"]))
    reference_plane_m = data.get("reference_plane_m")
    reference = (min(planes) + max(planes)) / 2 if reference_plane_m is None else mp.mpf(reference_plane_m)
    force, moment = [mp.mpc(0), mp.mpc(0)], [mp.mpc(0), mp.mpc(0)]
    noise_force, noise_moment = ZERO, ZERO
    for co, counter, plane in masses:
        arm = plane - reference
        force = [force[0] + co, force[1] + counter]
        moment = [moment[0] + arm * co, moment[1] + arm * counter]
        size = abs(co) + abs(counter)
        noise_force += EPS * size
        noise_moment += EPS * size * (abs(arm) + abs(plane) + abs(reference))
    webs = tuple(_web(web, reference) for web in data.get("webs", ()))
    axial += [mp.mpf(web["position_m"]) for web in data.get("webs", ())]
    budget = data.get("max_total_mass_kg")
    omega = mp.mpf(data["speed_rpm"]) * mp.pi / 30
    return Machine(
        Pair(_cancelled(force, noise_force), _cancelled(moment, noise_moment)),
        webs,
        None if budget is None else mp.mpf(budget),
        omega * omega,
        ONE if max(axial) - min(axial) <= NOTHING else max(axial) - min(axial),
        (noise_force, noise_moment),
    )


def _cancelled(pair: list[Any], noise: Number) -> tuple[Any, Any]:
    """Phasors; exactly zero where what is left is the rounding of these numbers themselves."""
    return tuple(mp.mpc(0) if abs(phasor) <= noise * mp.mpf(10) ** -60 else phasor for phasor in pair)


def _reciprocating(data: Body) -> tuple[list[tuple[Any, Any, Number]], list[Number]]:
    """(co-rotating, counter-rotating, plane) of every mass, and the planes of the throws."""
    values, planes = [], []
    for throw in data["throws"]:
        plane, radius = mp.mpf(throw["position_m"]), mp.mpf(throw["crank_radius_m"])
        crank = unit(throw.get("crank_angle_deg", 0.0))
        planes.append(plane)
        values.append((mp.mpf(throw.get("rotating_mass_kg", 0.0)) * radius * crank, mp.mpc(0), plane))
        for row in throw.get("rows", ()):
            own = plane + mp.mpf(row.get("offset_m", 0.0))
            rod = row.get("connecting_rod") or {}
            mass, share = mp.mpf(rod.get("mass_kg", 0.0)), mp.mpf(rod.get("reciprocating_share", 1 / 3))
            half = (mp.mpf(row["reciprocating_mass_kg"]) + share * mass) * radius / 2
            axis = unit(row["axis_deg"])
            values.append((half * crank, half * axis**2 * mp.conj(crank), own))
            values.append(((1 - share) * mass * radius * crank, mp.mpc(0), own))
    return values, planes


def _scroll(data: Body) -> tuple[list[tuple[Any, Any, Number]], list[Number]]:
    orbit, plane = mp.mpf(data["orbit_radius_m"]), mp.mpf(data["orbiting_position_m"])
    values = [(mp.mpc(mp.mpf(data["orbiting_mass_kg"]) * orbit), mp.mpc(0), plane)]
    guide = data["anti_rotation"]
    own = mp.mpf(guide["position_m"])
    if guide["type"] == "oldham":
        half = mp.mpf(guide["mass_kg"]) * orbit / 2
        values.append((mp.mpc(half), half * unit(guide["axis_deg"]) ** 2, own))
    else:
        pins = guide["count"] * mp.mpf(guide.get("eccentric_mass_kg", 0.0)) * orbit
        values.append((mp.mpc(pins), mp.mpc(0), own))
    return values, [plane]


def _web(web: Body, reference: Number) -> Web:
    sector = web.get("sector")
    common = (
        mp.mpf(web["position_m"]) - reference,
        mp.mpf(web["counterweight_radius_m"]),
        mp.inf if web["max_mass_kg"] is None else mp.mpf(web["max_mass_kg"]),
    )
    if sector is None:
        return Web(*common)
    edge = unit(sector["half_angle_deg"])
    return Web(*common, unit(sector["centre_deg"]), edge.real, edge.imag)


@dataclass(frozen=True)
class Term:
    """weight |constant + influence| of force (0) or moment (1); ``share`` multiplies its co-rotating phasor."""

    response: int
    share: Number
    constant: Any
    row: int


@dataclass(frozen=True)
class Goal:
    """P(u) = max over rows of floor + sum of terms, in N; ceilings on co-rotating phasors, in kg m and kg m^2."""

    terms: tuple[Term, ...]
    floors: tuple[Number, ...]
    ceilings: tuple[tuple[int, Number], ...]  # response, cap
    least_mass: bool

    def value(self, pair: Pair) -> Number:
        """Objective of a pair of phasors; exact."""
        rows = list(self.floors)
        for term, size in self._sizes(pair):
            rows[term.row] += size
        return max(rows)

    def _sizes(self, pair: Pair) -> list[tuple[Term, Number]]:
        co = (pair.force[0], pair.moment[0])
        return [(term, abs(term.constant + term.share * co[term.response])) for term in self.terms]


def goal(body: Body, machine: Machine) -> Goal:
    """The objective of a request; values are per omega^2."""
    objective = body.get("objective", {})
    across = objective.get("direction_weights", {})
    x, y = mp.mpf(across.get("x", 1.0)), mp.mpf(across.get("y", 1.0))
    moment = objective.get("moment_weight")
    weights = (mp.mpf(objective.get("force_weight", 1.0)), 1 / machine.span if moment is None else mp.mpf(moment))
    terms, floors = [], []
    for response, (weight, pair) in enumerate(zip(weights, _pairs(machine.baseline), strict=True)):
        if weight == 0:
            continue
        p, q = weight * (x + y) / 2, weight * (x - y) / 2
        row, back = len(floors), mp.conj(pair[1])
        floors.append(ZERO)
        # the weighted vector is the pair p f + q conj b, p b + q conj f
        if q == 0:
            floors[row] = p * abs(back)
            terms.append(Term(response, p, mp.mpc(0), row))
        else:
            terms += [Term(response, p, q * back, row), Term(response, q, p * back, row)]
    if objective.get("combine", "sum") == "sum":
        floors = [sum(floors, ZERO)]
        terms = [Term(term.response, term.share, term.constant, 0) for term in terms]
    return Goal(tuple(terms), tuple(floors), _ceilings(objective, machine), objective.get("least_mass", True))


def _ceilings(body: Body, machine: Machine) -> tuple[tuple[int, Number], ...]:
    pair = (body.get("force_ceiling_N"), body.get("moment_ceiling_Nm"))
    return tuple(
        (response, mp.mpf(ceiling) / machine.omega_squared - abs(pair[1]))
        for response, (ceiling, pair) in enumerate(zip(pair, _pairs(machine.baseline), strict=True))
        if ceiling is not None
    )


def _pairs(pair: Pair) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    return pair.force, pair.moment
