"""``python -m tests.program.recorded``: writes down what the functions of the program come to.

Nothing of it is a search: what a solver finds is judged elsewhere, whichever way it found it.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program import certificate, plate_pieces, scaling
from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound
from optimizer.program.cuts.cut import EXACT, Cut, Scatter
from optimizer.program.cuts.exact_penalty import under_levels
from optimizer.program.cuts.floors import floor_multipliers
from optimizer.program.cuts.misplacement import largest_last_goals
from optimizer.program.cuts.proof import proofs, resting_proof
from optimizer.program.cuts.samples import Samples
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.equal_unknowns import apart, united
from optimizer.program.limits import Limits
from optimizer.program.methods import implied_bounds, plate_sizes, rounding
from optimizer.program.methods.semicontinuous_bounds import within_semicontinuous_reach
from optimizer.program.multipliers import (
    mass_multipliers,
    objective_multipliers,
    resting_multipliers,
    supporting_multipliers,
)
from optimizer.program.points import points_at
from optimizer.program.rows import statement, total_mass
from optimizer.program.statement import Statement
from tests.prints import Record
from tests.program.alone import masses_by_inverse, responses
from tests.program.cases import random_point, stacked
from tests.program.test_alike import GROUPS, alike
from tests.program.test_leading_axes import FUNCTIONS, KINDS, WEBS, _multipliers, _program
from tests.program.test_multipliers import _INSIDE, _wide
from tests.program.test_plate_pieces import PLATES
from tests.program.test_scalars import quantity
from tests.program.test_stages import _several
from tests.program.turning import bearings

_SEEDS = range(6)
_EPS = float(np.finfo(float).eps)


def _point(seed: int, program: Statement) -> Complex:
    return random_point(np.random.default_rng(seed), program.limits)


def _of_all(name: str, kind: str) -> Any:
    """Of programs together, by arrays."""
    alone = [_program(seed, kind) for seed in _SEEDS]
    proof = certificate.together(_multipliers(seed, alone_statement) for seed, alone_statement in enumerate(alone))
    return FUNCTIONS[name](
        stacked(alone), np.stack([_point(n, alone_statement) for n, alone_statement in enumerate(alone)]), proof
    )


def _of_single(name: str, kind: str) -> Any:
    """Of one program, by compiled loops where those are for it."""
    program = _program(3, kind)
    return FUNCTIONS[name](program, _point(3, program), _multipliers(3, program))


def _rounded(kind: str) -> list[Any]:
    """What bounds give up for their rounding, in units of it.

    All is made of powers of 2 and cancels, so that nothing but the count of roundings is left.
    """
    program = _program(2, kind)
    count, ceilings = program.row.size, len(program.ceilings.names)
    large, ones = 2.0**30, np.ones(WEBS)
    power = 2.0 ** np.arange(WEBS)
    limits = Limits(0.5 * ones, 8.0 * ones, np.ones(WEBS, bool), ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))
    limits = replace(limits, max_total_mass=np.asarray(16.0)) if "budget" in kind else limits
    variant = replace(
        program,
        norms=replace(program.norms, constant=np.full(count, -large + 0j), influence=np.tile(power, (count, 1))),
        floor=np.where(program.where_largest(np.ones(program.floor.shape)) > 0, 2.0 + large, large),
        ceilings=replace(program.ceilings, size=np.full(ceilings, 4.0), cap=np.full(ceilings, 2.0)),
        limits=replace(limits, alike=None),
    )
    row = variant.where_largest(np.ones(variant.floor.shape))
    term = row[variant.row] * np.where(np.arange(count) == variant.row.searchsorted(variant.row), 1.0, 0.0)
    proof = Multipliers(term + 0j, row, np.full(ceilings, 0.25 + 0j))
    bound = objective_lower_bound(variant, proof)
    free = replace(variant, norms=replace(variant.norms, influence=0.0 * variant.norms.influence))
    mass = mass_lower_bound(free, proof, np.asarray(1.0))
    exact = certificate._minorants(variant, proof, with_tolerance=False, normal=True)
    # limits that are far away, beside which slopes are summed in finer numbers
    distant = replace(
        variant, limits=replace(variant.limits, max_mass=2.0**40 * ones, max_total_mass=np.asarray(np.inf))
    )
    finer = certificate._minorants(distant, proof, with_tolerance=False, normal=True)
    # of ceilings, whose numbers are no powers, the rounding of the sum itself would be all
    rounded = [] if "ceiling" in kind else [(values - np.rint(values)) / _EPS for values in (bound, exact.constant)]
    return [
        rounded, bound, mass, exact.constant, exact.slope, exact.rounding / _EPS, exact.support,
        finer.rounding / _EPS, finer.support,
    ]  # fmt: skip


def _scaled(kind: str) -> list[Any]:
    actual_data = []
    for seed, stage in ((1, "objective"), (2, "mass")):
        program = _program(seed, kind)
        data, units = scaling.scale(program, stage, 0.3, 0.1, 2.0, 5.0)  # type: ignore[arg-type]
        actual_data += [data, units]
        none = replace(program, norms=replace(program.norms, constant=0.0 * program.norms.constant))
        actual_data.append(scaling.scale(none, "objective", 0.3)[1])
    return actual_data


def _sharper(kind: str) -> list[Any]:
    program = _wide(kind)
    solver = _multipliers(4, program)
    return [
        list(resting_multipliers(program)), list(objective_multipliers(program, _INSIDE, solver)),
        list(mass_multipliers(program, 0.01 * _INSIDE, solver.times(np.asarray(50.0)))),
        list(supporting_multipliers(program, _INSIDE)),
    ]  # fmt: skip


def _settled(kind: str) -> list[Any]:
    """Points next to limits, edges and nothing, and what the others make up for it."""
    program = _program(5, kind).alone()
    limits = program.limits
    size = limits.reach * np.array([1e-7, 0.4, 1.0 - 1e-7, 0.3])
    turn = limits.centre * np.array([1.0, 1.0, 1.0j, 1.0]) * np.exp(1j * np.arange(WEBS))
    u = limits.into(size * turn)
    points = points_at(program, u)
    worse = 1.1 * points.objective
    snap_to_limits = [rounding.snap_to_limits(program, points, target, bound) for target in (points.objective, worse)
             for bound in (None, 0.9 * points.mass)]  # fmt: skip
    return [snap_to_limits, rounding.has_dust(limits, u)]


def _alike(number: int) -> list[Any]:
    """Programs of webs that are alike, with and without mirror images."""
    webs = alike(*GROUPS[number], 3)
    rng = np.random.default_rng(number)
    program = _program(3, "plain")
    influence, ones = rng.normal(size=(program.row.size, 6)), np.ones(6)
    limits = Limits(0.3 * ones, 4.0 * ones, np.ones(6, bool), ones + 0j, 0.0 * ones, ones, np.asarray(9.0), webs)
    whole = replace(program, norms=replace(program.norms, influence=influence), limits=limits)
    none = whole.ceilings.norms
    whole = replace(whole, ceilings=replace(whole.ceilings, norms=replace(none, influence=np.zeros((0, 6)))))
    u = rng.normal(size=(6, 2)) @ [1, 1j]
    proof = _multipliers(2, whole)
    means = [
        webs.means(u), webs.nearest(u), webs.angles(2, 0.4), webs.fitted(np.abs(u), np.abs(50.0 * u)),
        webs.summed(u.real),
        limits.into(3.0 * u), limits.support(u), whole.objective(u), scaling.scale(whole, "objective", 0.4)[0],
        objective_lower_bound(whole, proof), mass_lower_bound(whole, proof, np.asarray(1.0)),
    ]  # fmt: skip
    if webs.plain:
        actual_statement = united(whole, webs)
        means += [actual_statement.norms, actual_statement.limits, apart(u[: webs.first.size], webs)]
    scattered = replace(whole, norms=replace(whole.norms, scatter=0.1))
    return [*means, certificate.spread(scattered, proof), objective_lower_bound(scattered, proof)]


def _reach(kind: str) -> list[Any]:
    """Limits that are implied where there are none."""
    numbers = []
    for seed, some in ((0, (0,)), (1, (1, 3)), (2, (0, 1, 2, 3))):
        program, far = _program(seed, kind), np.isin(np.arange(WEBS), some)
        wide = replace(program.limits, max_mass=np.where(far, np.inf, program.limits.max_mass))
        variant = replace(program, limits=wide)
        level = float(implied_bounds.level_above(variant, np.zeros(WEBS, complex)))
        least = np.where(far, 0.05, 0.0)
        bounded = [implied_bounds.bounded(variant, level), within_semicontinuous_reach(variant, least, level)]
        # linear programs are solved to some digits alone
        numbers.append(
            [np.round(np.log(np.minimum(single_statement.limits.max_mass, 1e300)), 6) for single_statement in bounded]
        )
        rows, most, scalar = responses(variant, far, level)
        numbers.append([rows, most, scalar, implied_bounds.far_limits(variant)])
        if len(rows) >= far.sum():
            numbers.append([masses_by_inverse(rows * 0.3, most)])
    return numbers


def _pieces() -> list[Any]:
    whole = _program(3, "sector, budget")
    nodes = plate_pieces.first_nodes(PLATES)
    closer = plate_pieces.closer_nodes(nodes, np.array([0.3, 0.7, 0.8]))
    angle = np.array([0.31, 0.47, 0.53])
    u = np.zeros(WEBS, complex)
    u[PLATES.webs] = PLATES.unbalance(angle) * np.exp(1j * np.arange(3))
    u[2] = 0.02
    webs = plate_pieces.tangents(PLATES, closer)
    cut = plate_pieces.pieces(whole, PLATES, webs)
    weights = plate_sizes.CutWeights(u, angle, 3.0)
    alone = _program(3, "sector, budget").alone()
    return [
        nodes, closer, webs, cut.owner, cut.program.limits, cut.program.norms.influence,
        plate_pieces.nodes_about(PLATES, nodes, u, 1e-7), plate_pieces.total_mass(PLATES, whole.limits.radius, u),
        plate_sizes.at_limits(alone, weights), plate_sizes.total_mass(alone, PLATES, u, angle),
        plate_sizes.unlike(PLATES, angle), list(plate_sizes.equal_sizes(alone, PLATES, weights)),
    ]  # fmt: skip


def _over_turn(name: str) -> Problem:
    if name == "several":
        return _several()
    if name == "turning":
        rng = np.random.default_rng(5)
        turning = tuple(
            quantity(rng, rng.choice([-2.0, -1.0, 0.0, 1.0], 6), scalar, str(scalar)) for scalar in (True, False)
        )
        return replace(bearings(2, count=2), quantities=turning)
    return bearings(1, measure="rms" if name == "rms" else "peak", beside=name == "beside")


OVER_TURN = ("several", "bearings", "rms", "beside", "turning")


def _sampled(name: str) -> list[Any]:
    program = _over_turn(name)
    webs = program.limits.radius.size
    u = 0.05 * (np.random.default_rng(3).normal(size=(webs, 2)) @ [1, 1j])
    samples, count = Samples(program.quantities), len(program.quantities)
    sizes = [
        [
            samples.sizes(u, scatter),
            _cuts(samples.highest(u, scatter, np.zeros(count))),
            _cuts(samples.highest(u, scatter, np.full(count, 9.0))),
        ]
        for scatter in (EXACT, Scatter(0.1, 0.01))
    ]
    harmonics = [cut for program_quantity in program.quantities for cut in program_quantity.harmonics(2.0)]
    return [sizes, _of_cuts(list(chain(*samples.first()))), _of_cuts(harmonics)]


def _cuts(several: Iterable[Sequence[Any]]) -> list[Any]:
    every = list(chain(*several))
    return [
        np.array([[bracket.lower, bracket.upper] for bracket in every]),
        _of_cuts([bracket.cut for bracket in every]),
    ]


def _of_cuts(cuts: Sequence[Cut]) -> list[Any]:
    angles = [0.0 if cut.angle_deg is None else np.exp(1j * np.deg2rad(cut.angle_deg)) for cut in cuts]
    shares = [1.0 if cut.share is None else cut.share for cut in cuts]
    parts = [[cut.constant, cut.floor, share, float(cut.scalar)] for cut, share in zip(cuts, shares, strict=True)]
    return [np.array(angles), np.array([cut.influence for cut in cuts]), np.array(parts)]


def _proven(name: str) -> list[Any]:
    program = _over_turn(name)
    webs = program.limits.radius.size
    u = 0.05 * (np.random.default_rng(3).normal(size=(webs, 2)) @ [1, 1j])
    begun, rest = program.begun, program.at_rest
    rng = np.random.default_rng(1)
    term = 0.1 * (rng.normal(size=(begun.row.size, 2)) @ [1, 1j])
    dual = Multipliers(term, rng.uniform(size=begun.floor.size), np.full(len(begun.ceilings.names), 0.1j))
    levels = [0.9 * rest.goals[:-1], rest.goals]
    proven = [
        _of_proof(proof) for counted in levels for proof in proofs(program, program.first, begun, u, dual, counted)
    ]
    penalty = under_levels(begun, program, 0.8 * rest.goals[:-1], 0.1, 3.0)
    norms = [begun.norms, begun.floor, begun.group, begun.ceilings.cap, begun.ceilings.size, program.units]
    values = program.values(u, 1e-9)
    samples, _ = program.sample_values(u, np.zeros(len(program.quantities)))
    return [
        norms, rest.goals, _of_proof(resting_proof(program, program.first, begun)), proven, penalty.floor,
        penalty.norms, values.goals, values.excess, values.over_budget, samples.goals,
        floor_multipliers(program, program.first, begun),
        program.sizes, program.yardsticks,
        *(largest_last_goals(program, u, values.reached, 0.1, 0.05) if name in ("bearings", "rms", "beside") else ()),
    ]  # fmt: skip


def _of_proof(proof: Any) -> list[Any]:
    up_to = proof.up_to(0.1).bound
    return [proof.bound, proof.multipliers, proof.charge, proof.cuts, proof.prices, proof.scale, up_to]


def _weighed() -> list[Any]:
    program = _program(1, "budget")
    mass = statement([[total_mass(program.limits)]], [], program.limits)
    return [mass.norms.influence, mass.objective(_point(1, program))]


def cases() -> dict[str, Callable[[], Any]]:
    """What is written down, by name."""
    functions: dict[str, Callable[[], Any]] = {}
    for kind in KINDS:
        for name in FUNCTIONS:
            functions[f"{name} of {kind}"] = partial(_of_all, name, kind)
            functions[f"{name} of one {kind}"] = partial(_of_single, name, kind)
        of_kind = {"rounding": _rounded, "scaling": _scaled, "settled": _settled}
        if kind in ("plain", "sector, budget", "scalar, ceiling", "scatter"):
            of_kind["reach"] = _reach
        if "ceiling, scatter" not in kind:
            of_kind["sharper"] = _sharper
        functions |= {f"{name} of {kind}": partial(function, kind) for name, function in of_kind.items()}
    functions |= {f"alike {number}": partial(_alike, number) for number in range(len(GROUPS))}
    for name in OVER_TURN:
        functions |= {f"samples of {name}": partial(_sampled, name), f"proofs of {name}": partial(_proven, name)}
    return functions | {"pieces": _pieces, "mass": _weighed}


RECORD = Record(Path(__file__).with_name("recorded.json"), cases())


if __name__ == "__main__":
    RECORD.write()
