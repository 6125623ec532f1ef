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

from optimizer.arrays import Complex, Real
from optimizer.certified import Certified, certified, judged
from optimizer.formulate import formulate
from optimizer.mechanics.envelope import Envelope
from optimizer.program.certificate import mass_lower_bound
from optimizer.program.limits import Limits
from optimizer.program.optima import Optima, optima
from optimizer.program.reach import within_reach
from optimizer.program.reference.solver import Solver
from optimizer.program.statement import Statement
from optimizer.program.symmetry import symmetric
from optimizer.response import Response
from optimizer.shapes import envelopes, fitted
from schemas.requests import OptimizeRequest

#: half-angles at first, by their tangents: closer both where a plate is all but closed and where it is all but full
_FIRST = np.arctan(np.exp(np.linspace(-4.0, 4.0, 33)))
#: how many nodes are kept beside the ends, and how often others are laid
_KEPT, _ROUNDS = 9, 12
#: nodes are laid on both sides of one this share nearer than those that were there
_NARROWER = 0.25
#: tangents reach no less far than chords, whatever the rounding of their pieces
_REACHES = 1.0 + 1e-13
#: nodes that are nearer than this share of the largest half-angle are one
_SAME = 1e-9

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
    best: tuple[OptimizeRequest, Certified] | None = None
    end = thread_time() + request.accuracy.time_limit_s
    closed = request.model_copy(update={"machine": fitted(request.machine, dict.fromkeys(plates, 0.0))})
    whole = within_reach(formulate(closed.machine, request.objective, responses, omega_squared), solver)
    for _ in range(_ROUNDS):
        asked, found, called_for = _round(request, whole, plates, nodes, responses, omega_squared, solver)
        if best is None or _gap(found) <= _gap(best[1]):
            best = asked, found
        if found.status[0] != "inaccurate":
            return asked, found
        if thread_time() > end:
            break
        nodes = {k: _closer(nodes[k], called_for[k]) for k in plates}
    assert best is not None
    return best


def _gap(found: Certified) -> float:
    """What is left open of mass and objective, for rounds to be compared; inf where nothing is proven."""
    return float(np.nan_to_num(found.verdict.relative_gap[0] + found.verdict.mass_gap[0], nan=np.inf))


def _round(
    request: OptimizeRequest,
    whole: Statement,
    plates: Mapping[int, Envelope],
    nodes: _Nodes,
    responses: Sequence[Response],
    omega_squared: Real,
    solver: Solver,
) -> tuple[OptimizeRequest, Certified, Mapping[int, float]]:
    """What is found and what tangents prove, and the half-angles that the tangents call for."""
    goal, square = request.objective, omega_squared
    webs = range(len(request.machine.webs))
    owner = np.repeat(np.array(webs), [nodes[k].size - 1 if k in plates else 1 for k in webs])

    def optimum(laid: Callable[[Envelope, Real], _Webs]) -> tuple[Statement, Optima, Complex]:
        program = _pieces(whole, owner, {k: laid(plate, nodes[k]) for k, plate in plates.items()})
        found = optima(program, request.accuracy.relative_gap, goal.least_mass, solver)
        carried = np.zeros(len(webs), complex)
        np.add.at(carried, owner, found.unbalance[0])
        return program, found, carried

    tangents, proven, called_for = optimum(_tangents)
    u, spent = called_for, proven.certify_s
    if np.isfinite(whole.limits.max_total_mass[0]) and not proven.unreachable[0]:
        # what tangents call for may be heavier than the budget, what chords find is not
        _, feasible, u = optimum(_chords)
        proven = _up_to(tangents, proven, whole.objective(u) + whole.rounding(u))
        spent = spent + feasible.certify_s
    if goal.symmetric:
        # no worse in any term, so that what is proven of those that were found holds
        u = symmetric(whole, u[None], _kinds(request))[0]
    asked = request.model_copy(update={"machine": fitted(request.machine, _opened(plates, u))})
    program = formulate(asked.machine, goal, responses, square)
    program = replace(program, limits=_limits(program.limits, whole.limits, plates))
    found = judged(asked, program, replace(proven, unbalance=u[None], certify_s=spent), square)
    return asked, found, _opened(plates, called_for)


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


#: radii and largest masses of webs, m and kg
_Webs = tuple[Real, Real]


def _chords(plate: Envelope, nodes: Real) -> _Webs:
    mass = np.diff(plate.mass(nodes))
    return np.diff(plate.unbalance(nodes)) / mass, mass


def _tangents(plate: Envelope, nodes: Real) -> _Webs:
    """Webs no heavier than the plate: its tangents at all nodes but the last, as far as each is the highest."""
    unbalance, slope = plate.unbalance(nodes), 1.0 / plate.lever(nodes[:-1])
    at = unbalance[:-1]
    height = plate.mass(nodes[:-1]) - slope * at
    rise = np.diff(slope)
    crossing = np.where(rise > 0, -np.diff(height) / np.where(rise > 0, rise, 1.0), at[1:])
    ends = np.concatenate([[0.0], np.clip(crossing, at[:-1], at[1:]), unbalance[-1:]])
    return 1.0 / slope, np.diff(ends) * slope * _REACHES


def _pieces(whole: Statement, owner: np.ndarray, webs: Mapping[int, _Webs]) -> Statement:
    """The program with some webs in place of each plate."""
    limits = whole.limits
    parts = {
        name: getattr(limits, name)[..., owner].copy()
        for name in ("radius", "max_mass", "free", "centre", "half_angle_cos", "half_angle_sin")
    }
    for k, (radius, mass) in webs.items():
        parts["radius"][..., owner == k], parts["max_mass"][..., owner == k] = radius, mass
    return replace(
        whole,
        norms=whole.norms.only(owner),
        ceilings=whole.ceilings.only(owner),
        limits=Limits(**parts, max_total_mass=limits.max_total_mass),
    )


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
