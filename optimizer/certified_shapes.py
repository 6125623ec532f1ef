"""Certified counterweights that are cut from plates, whose mass is no multiple of their unbalance.

The mass m(U) of a plate is convex. Tangents of it are webs in one plane, each with a radius and a largest mass of its
own, which together are no heavier than what is cut: what is proven of them is proven of the plate. What they call for
is cut, and is the answer, but for a budget: then chords are, such webs too and no lighter, so that what they find keeps
it. Both are laid closer about what the tangents call for, until the gap is as asked.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from time import thread_time

import numpy as np

from optimizer.alike_plates import alike
from optimizer.arrays import Complex, Real
from optimizer.certified import Certified, certified, judged
from optimizer.formulate import formulate
from optimizer.limits import limits
from optimizer.mechanics.envelope import Envelope
from optimizer.plate_pieces import Webs, chords, pieces, tangents
from optimizer.program.certificate import mass_lower_bound
from optimizer.program.limits import Limits
from optimizer.program.optima import Optima, optima
from optimizer.program.reach import within_reach
from optimizer.program.reference.solver import Solver
from optimizer.program.statement import Statement
from optimizer.program.symmetry import symmetric
from optimizer.program.verdict import MASS_GAP, mass_resolution, yardstick
from optimizer.response import Response
from optimizer.shapes import envelopes, fitted
from schemas.requests import OptimizeRequest

#: half-angles at first, by their tangents: closer both where a plate is all but closed and where it is all but full
_FIRST = np.arctan(np.exp(np.linspace(-4.0, 4.0, 33)))
#: how many nodes are kept beside the ends, and how often others are laid
_KEPT, _ROUNDS = 9, 12
#: nodes are laid on both sides of one this share nearer than those that were there
_NARROWER = 0.25
#: nodes that are nearer than this share of the largest half-angle are one
_SAME = 1e-9
#: a mass this many times as far above its bound as is allowed is not worth judging
_FAR = 2.0
#: masses that are not told apart are at most this many times as large with the radius that is cut as with the longest:
#: the centre of half a disc is at 0.42 of its radius
_NEARER = 2.5
#: openings that agree this closely, relative, are equal: what rounding leaves
_EQUAL = 1e-14

#: half-angles of every plate, from 0 to the largest, rad
_Nodes = Mapping[int, Real]


def certified_shapes(
    request: OptimizeRequest, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> tuple[OptimizeRequest, Certified]:
    """Certified counterweights of one request, and the request with the radii that they come to.

    Parameters
    ----------
    omega_squared : (1,) rad^2/s^2.
    """
    plates = envelopes(request.machine)
    if not plates:
        return request, certified(request, responses, omega_squared, solver)
    nodes: _Nodes = {k: _nodes(_FIRST, float(plate.most)) for k, plate in plates.items()}
    tried: list[Optima] = []
    end = thread_time() + request.accuracy.time_limit_s
    closed = request.model_copy(update={"machine": fitted(request.machine, dict.fromkeys(plates, 0.0))})
    whole = within_reach(formulate(closed.machine, request.objective, responses, omega_squared), solver)

    def cut(proven: Optima) -> tuple[OptimizeRequest, Certified]:
        return _cut(request, whole, plates, proven, omega_squared)

    for _ in range(_ROUNDS):
        proven, called_for = _round(request, whole, plates, nodes, solver)
        tried.append(proven)
        if not _too_heavy(request, whole, plates, proven):
            asked, found = cut(proven)
            if found.status[0] == "optimal":
                even = _alike(request, whole, plates, nodes, proven)
                if np.array_equal(even.unbalance, proven.unbalance):
                    return asked, found
                best = cut(even)
                return best if best[1].status[0] == "optimal" else (asked, found)
            if found.status[0] != "inaccurate":
                return asked, found
        if thread_time() > end:
            break
        nodes = {k: _closer(nodes[k], called_for[k]) for k in plates}
    # of those that are equally near the last
    return min((cut(proven) for proven in reversed(tried)), key=lambda each: _gap(each[1]))


def _too_heavy(request: OptimizeRequest, whole: Statement, plates: Mapping[int, Envelope], proven: Optima) -> bool:
    """Whether what would be cut is so far above the least mass that it need not be judged."""
    if not request.objective.least_mass or proven.unreachable[0]:
        return False
    opened, mass = _opened(plates, proven.unbalance[0]), np.abs(proven.unbalance[0]) / whole.limits.radius[0]
    for k, plate in plates.items():
        mass[k] = plate.mass(opened[k])
    total = np.add.reduce(mass)
    size = np.maximum(total, _NEARER * mass_resolution(whole, yardstick(whole)[..., None])[0])
    return bool(total - proven.mass_lower_bound[0] > _FAR * MASS_GAP * size)


def _gap(found: Certified) -> float:
    """What is left open of mass and objective, for rounds to be compared; inf where nothing is proven."""
    return float(np.nan_to_num(found.verdict.relative_gap[0] + found.verdict.mass_gap[0], nan=np.inf))


def _round(
    request: OptimizeRequest,
    whole: Statement,
    plates: Mapping[int, Envelope],
    nodes: _Nodes,
    solver: Solver,
) -> tuple[Optima, Mapping[int, float]]:
    """What is found with what tangents prove, and the half-angles that the tangents call for."""
    goal, webs = request.objective, range(len(request.machine.webs))
    owner = np.repeat(np.array(webs), [nodes[k].size - 1 if k in plates else 1 for k in webs])

    def optimum(laid: Callable[[Envelope, Real], Webs]) -> tuple[Statement, Optima, Complex]:
        program = pieces(whole, owner, {k: laid(plate, nodes[k]) for k, plate in plates.items()})
        found = optima(program, request.accuracy.relative_gap, goal.least_mass, solver)
        carried = np.zeros(len(webs), complex)
        np.add.at(carried, owner, found.unbalance[0])
        return program, found, carried

    program, proven, called_for = optimum(tangents)
    u, spent = called_for, proven.certify_s
    if np.isfinite(whole.limits.max_total_mass[0]) and not proven.unreachable[0]:
        # what tangents call for may be heavier than the budget, what chords find is not
        _, feasible, u = optimum(chords)
        proven = _up_to(program, proven, whole.objective(u) + whole.rounding(u))
        spent = spent + feasible.certify_s
    if goal.symmetric:
        # no worse in any term, so that what is proven of those that were found holds
        u = symmetric(whole, u[None], _kinds(request))[0]
    return replace(proven, unbalance=u[None], certify_s=spent), _opened(plates, called_for)


def _alike(
    request: OptimizeRequest, whole: Statement, plates: Mapping[int, Envelope], nodes: _Nodes, proven: Optima
) -> Optima:
    """The same with plates opened alike, where what is proven still holds."""
    goal, lower_bound = request.objective, float(proven.lower_bound[0])
    largest = lower_bound + float(request.accuracy.relative_gap * yardstick(whole)[0])
    least_mass = np.inf
    if goal.least_mass:
        largest, least_mass = min(largest, float(proven.mass_target[0])), float(proven.mass_lower_bound[0])
    u = alike(whole, plates, nodes, _kinds(request), proven.unbalance[0], (lower_bound, largest), least_mass)
    return replace(proven, unbalance=u[None])


def _cut(
    request: OptimizeRequest,
    whole: Statement,
    plates: Mapping[int, Envelope],
    proven: Optima,
    omega_squared: Real,
) -> tuple[OptimizeRequest, Certified]:
    """The request with the radii of what is cut, and what may be claimed of it."""
    opened, same = _opened(plates, proven.unbalance[0]), np.arange(len(request.machine.webs))
    alike, kinds = whole.limits.alike, _kinds(request)
    if alike is not None:
        opened = {k: opened[alike.leader[k]] for k in plates}
    for k, angle in opened.items():
        # to the last digit
        same[k] = next(j for j in plates if kinds[j] == kinds[k] and abs(opened[j] - angle) <= _EQUAL * angle)
    alike_to = {k: opened[int(same[k])] for k in plates}
    asked = request.model_copy(update={"machine": fitted(request.machine, alike_to)})
    stated = limits(asked.machine, omega_squared.shape)
    program = replace(whole, limits=_limits(stated, whole.limits, plates))
    found = judged(asked, program, proven, omega_squared, lambda mass, angle: (mass[..., same], angle))
    return asked, found


def _up_to(program: Statement, proven: Optima, objective: Real) -> Optima:
    """What is proven of the mass of all up to an objective (1,): under a budget chords may reach no smaller one.

    Any target proves a bound with the same multipliers; a larger one a smaller bound.
    """
    if np.all(objective <= proven.mass_target):
        return proven
    target = np.maximum(proven.mass_target, objective)
    bound = np.minimum(mass_lower_bound(program, proven.mass_multipliers, target), proven.mass_lower_bound)
    return replace(proven, mass_target=target, mass_lower_bound=bound)


def _kinds(request: OptimizeRequest) -> np.ndarray:
    """Webs with the same plate have the same number, those without one another."""
    cut = [web.envelope for web in request.machine.webs]
    return np.array([cut.index(each) for each in cut])


def _opened(plates: Mapping[int, Envelope], u: Complex) -> dict[int, float]:
    return {k: float(plate.opened(np.abs(u[k]))) for k, plate in plates.items()}


def _limits(stated: Limits, reached: Limits, plates: Mapping[int, Envelope]) -> Limits:
    """Limits of webs with the radii that were found; what the others may reach at most is as it was proven."""
    most = stated.max_mass.copy()
    plain = [k for k in range(most.shape[-1]) if k not in plates]
    most[..., plain] = reached.max_mass[..., plain]
    return replace(stated, max_mass=most)


def _nodes(inner: Real, most: float) -> Real:
    """Nodes from 0 to the largest half-angle, none next to another."""
    every = np.unique(np.concatenate([[0.0], inner[inner < most], [most]]))
    apart = np.diff(every) > _SAME * most
    return np.concatenate([every[:-1][apart], [most]])


def _closer(nodes: Real, angle: float) -> Real:
    """Nodes at a half-angle and halfway to those beside it; of the others the nearest."""
    most = float(nodes[-1])
    after = int(np.clip(np.searchsorted(nodes, angle), 1, nodes.size - 1))
    beside = nodes[[after - 1, after]]
    every = np.concatenate([nodes[1:-1], [angle], angle + _NARROWER * (beside - angle)])
    nearest = every[np.argsort(np.abs(every - angle), kind="stable")][:_KEPT]
    return _nodes(nearest[nearest > 0], most)
