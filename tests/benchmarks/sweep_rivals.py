"""Other ways to solve both stages of a design, each as a good engineer would with that tool.

Stage 1: minimise the sum of t_j subject to |constant_j + influence_j p| <= t_j, |p_k| <= 1.
Stage 2: minimise mass @ f subject to the same with |p_k| <= f_k <= 1 and the sum of t_j at most the target.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import clarabel
import cvxpy as cp
import moreau
import numpy as np
from scipy import sparse

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound
from tests.benchmarks.sweep_case import Program

#: share of what optima may differ by that the second stage may use: solvers are exact to a tolerance only
_USED = 0.9


class Stages(NamedTuple):
    """What both stages found: shares of the reach (K, 2), multipliers of the terms and of the target."""

    smallest: Real
    lightest: Real
    smallest_terms: Complex
    lightest_terms: Complex
    price: float
    smallest_ceilings: Complex = np.zeros(0, complex)
    lightest_ceilings: Complex = np.zeros(0, complex)


Method = Callable[[Program], Stages]


class Gaps(NamedTuple):
    """What the answer of a method is certified to."""

    objective: float  # relative to the objective without counterweights
    mass: float  # relative to the mass


def gaps(program: Program, stages: Stages) -> Gaps:
    """Certified gaps of an answer, by the same closed-form bounds that our own answers are judged by."""
    statement = program.statement
    first, last = (program.unbalance(p) for p in (stages.smallest, stages.lightest))
    bound = float(
        objective_lower_bound(statement, Multipliers(stages.smallest_terms, np.ones(1), stages.smallest_ceilings))
    )
    per_objective = program.mass_unit / program.unit
    multipliers = Multipliers(
        *(
            values * per_objective
            for values in (stages.lightest_terms, np.array([stages.price]), stages.lightest_ceilings)
        )
    )
    counted = max(float(statement.objective(first)), bound) + program.share * program.unit
    mass, lightest = float(statement.mass(last)), float(mass_lower_bound(statement, multipliers, np.asarray(counted)))
    rest = float(statement.objective(np.zeros_like(last)))
    return Gaps((float(statement.objective(last)) - bound) / rest, (mass - lightest) / mass if mass > 0 else 0.0)


def vectors_of(dual: Real) -> Complex:
    """Multipliers of vectors (J, 2) in cones, as complex numbers."""
    return -(dual[:, 0] + 1j * dual[:, 1])


def target(objective: float, program: Program) -> float:
    """Largest value of an optimum."""
    return objective + _USED * program.share


class _Built(NamedTuple):
    """Both stages as cvxpy problems."""

    first: cp.Problem
    p: cp.Variable
    terms: cp.Constraint
    second: cp.Problem
    p2: cp.Variable
    terms2: cp.Constraint
    budget: cp.Constraint

    def stages(self) -> Stages:
        duals = [np.reshape(cone.dual_value[1].T, (-1, 2)) for cone in (self.terms, self.terms2)]
        return Stages(self.p.value, self.p2.value, *map(vectors_of, duals), float(self.budget.dual_value))


def _build(constant: Any, influence: Any, mass: Any, most: Any, terms: int, webs: int) -> _Built:
    p, t = cp.Variable((webs, 2)), cp.Variable(terms)
    cone = cp.SOC(t, (constant + influence @ p).T, axis=0)
    first = cp.Problem(cp.Minimize(cp.sum(t)), [cone, cp.norm(p, axis=1) <= 1])
    p2, f, t2 = cp.Variable((webs, 2)), cp.Variable(webs), cp.Variable(terms)
    cone2, budget = cp.SOC(t2, (constant + influence @ p2).T, axis=0), cp.sum(t2) <= most
    second = cp.Problem(cp.Minimize(mass @ f), [cone2, budget, cp.norm(p2, axis=1) <= f, f <= 1])
    return _Built(first, p, cone, second, p2, cone2, budget)


def rebuilt(program: Program) -> Stages:
    """(a) cvxpy, the problems written down anew for every design."""
    most = cp.Constant(0.0)
    data = program.constant, program.influence, program.mass
    first = _build(*data, most, *program.influence.shape)
    first.first.solve(cp.CLARABEL)
    both = _build(*data, target(first.first.value, program), *program.influence.shape)
    both.second.solve(cp.CLARABEL)
    return both._replace(p=first.p, terms=first.terms).stages()


class Parametrised:
    """(b) cvxpy, the problems compiled once with parameters (DPP)."""

    def __init__(self, like: Program) -> None:
        terms, webs = like.influence.shape
        self._data = cp.Parameter((terms, 2)), cp.Parameter((terms, webs)), cp.Parameter(webs), cp.Parameter()
        self._built = _build(*self._data, terms, webs)
        assert self._built.first.is_dpp()
        assert self._built.second.is_dpp()

    def __call__(self, program: Program) -> Stages:
        constant, influence, mass, most = self._data
        constant.value, influence.value, mass.value = program.constant, program.influence, program.mass
        self._built.first.solve(cp.CLARABEL)
        most.value = target(self._built.first.value, program)
        self._built.second.solve(cp.CLARABEL)
        return self._built.stages()


class Prepared(NamedTuple):
    """What changes of a design in the matrices of both stages."""

    values: tuple[Real, Real]  # of the sparse matrices
    sides: tuple[Real, Real]  # right sides, that of the second without its target
    mass: Real  # costs of the second


def settings(tuned: bool) -> clarabel.DefaultSettings:
    """What clarabel is asked for: as it comes, or to no more digits than the gaps of the tables need."""
    default_settings = clarabel.DefaultSettings()
    default_settings.verbose = default_settings.presolve_enable = False
    if tuned:
        default_settings.equilibrate_enable = default_settings.iterative_refinement_enable = False
        default_settings.tol_gap_abs = default_settings.tol_gap_rel = default_settings.tol_feas = 1e-7
        default_settings.max_step_fraction = 0.995
    return default_settings


class Direct:
    """(c) and (d) clarabel without a modelling layer: sparse matrices prepared beforehand, only their data updated.

    clarabel solves A v + s = b with s in the cones.

    tuned : to no more digits than the gaps of the table need, without equilibration and refinement, which these well
        scaled programs do without.
    """

    def __init__(self, like: Program, tuned: bool = False) -> None:
        self._terms, self._webs = like.influence.shape
        prepared = self.prepare(like)
        costs = self.first_cost, prepared.mass
        plane = clarabel.SecondOrderConeT(3)
        cones = (
            [plane] * (self._webs + self._terms),
            [clarabel.NonnegativeConeT(self._webs + 1), *[plane] * (self._webs + self._terms)],
        )
        self._solvers = [
            clarabel.DefaultSolver(sparse.csc_matrix((cost.size, cost.size)), cost, matrix, side, cone, settings(tuned))
            for cost, matrix, side, cone in zip(costs, self.matrices(like), prepared.sides, cones, strict=True)
        ]

    @property
    def first_cost(self) -> Real:
        """Costs of the first stage."""
        return np.concatenate([np.zeros(2 * self._webs), np.ones(self._terms)])

    def prepare(self, program: Program) -> Prepared:
        """The data of a design."""
        terms, webs = self._terms, self._webs
        constant = np.concatenate([np.zeros((terms, 1)), program.constant], axis=-1).ravel()
        discs = np.tile([1.0, 0.0, 0.0], webs)
        first = np.concatenate([discs, constant])
        second = np.concatenate([np.ones(webs), [0.0], np.zeros(3 * webs), constant])
        mass = np.concatenate([np.zeros(2 * webs), program.mass, np.zeros(terms)])
        value, two = self.matrices(program)
        return Prepared((value.data, two.data), (first, second), mass)

    def matrices(self, program: Program) -> tuple[sparse.csc_matrix, sparse.csc_matrix]:
        """Variables p (x and y of each web in turn), f in the second stage, t."""
        terms, webs = self._terms, self._webs
        place = np.zeros((3 * webs, 2 * webs))
        for k in range(webs):
            place[3 * k + 1, 2 * k] = place[3 * k + 2, 2 * k + 1] = -1.0
        vectors = np.zeros((3 * terms, 2 * webs))
        vectors[1::3, 0::2] = vectors[2::3, 1::2] = -program.influence
        sizes, fractions = np.zeros((3 * terms, terms)), np.zeros((3 * webs, webs))
        sizes[::3], fractions[::3] = -np.eye(terms), -np.eye(webs)
        first = np.block([[place, np.zeros((3 * webs, terms))], [vectors, sizes]])
        second = np.block(
            [
                [np.zeros((webs, 2 * webs)), np.eye(webs), np.zeros((webs, terms))],
                [np.zeros((1, 3 * webs)), np.ones((1, terms))],
                [place, fractions, np.zeros((3 * webs, terms))],
                [vectors, np.zeros((3 * terms, webs)), sizes],
            ]
        )
        return sparse.csc_matrix(first), sparse.csc_matrix(second)

    def solve(self, program: Program, prepared: Prepared) -> Stages:
        """Both stages of a design."""
        terms, webs = self._terms, self._webs
        first, second = self._solvers
        first.update(A=prepared.values[0], b=prepared.sides[0])
        smallest = first.solve()
        side = prepared.sides[1]
        side[webs] = target(smallest.obj_val, program)
        second.update(q=prepared.mass, A=prepared.values[1], b=side)
        lightest = second.solve()
        duals = [
            np.array(single_smallest.z[-3 * terms :]).reshape(-1, 3)[:, 1:] for single_smallest in (smallest, lightest)
        ]
        places = [np.array(single_smallest.x[: 2 * webs]).reshape(-1, 2) for single_smallest in (smallest, lightest)]
        return Stages(*places, *map(vectors_of, duals), lightest.z[webs])


class Batch:
    """(e) moreau, the designs of a batch solved together: the same matrices, stacked beforehand."""

    def __init__(self, programs: Sequence[Program]) -> None:
        self._programs = programs
        self._terms, self._webs = programs[0].influence.shape
        direct = Direct(programs[0])
        stages = [
            [matrix.tocsr() for matrix in matrices]
            for matrices in zip(*(direct.matrices(program) for program in programs), strict=True)
        ]
        self._values = [np.stack([matrix.data for matrix in matrices]) for matrices in stages]
        prepared = [direct.prepare(program) for program in programs]
        self._costs = np.tile(direct.first_cost, (len(programs), 1)), np.stack([stages.mass for stages in prepared])
        self._sides = [np.stack(sides) for sides in zip(*(stages.sides for stages in prepared), strict=True)]
        planes = [3] * (self._webs + self._terms)
        cones = moreau.Cones(so_cone_dims=planes), moreau.Cones(num_nonneg_cones=self._webs + 1, so_cone_dims=planes)
        self._solvers = [self._compiled(matrices[0], cone) for matrices, cone in zip(stages, cones, strict=True)]

    def _compiled(self, matrix: sparse.csr_matrix, cones: moreau.Cones) -> moreau.CompiledSolver:
        rows, columns = matrix.shape
        settings = moreau.Settings(solver="ipm", device="cpu", batch_size=len(self._programs))
        quadratic, linear = np.zeros(columns + 1, dtype=int), (matrix.indptr, matrix.indices)
        return moreau.CompiledSolver(columns, rows, quadratic, np.zeros(0, dtype=int), *linear, cones, settings)

    def _stage(self, stage: int) -> Any:
        solver = self._solvers[stage]
        solver.setup(np.zeros((len(self._programs), 0)), self._values[stage])
        return solver.solve(self._costs[stage], self._sides[stage])

    def solve(self) -> list[Stages]:
        """Both stages of all designs."""
        smallest = self._stage(0)
        values = self._solvers[0].info.obj_val
        pairs = zip(values, self._programs, strict=True)
        self._sides[1][:, self._webs] = [target(optimum, program) for optimum, program in pairs]
        lightest = self._stage(1)
        duals = [
            single_smallest.z[:, -3 * self._terms :].reshape(-1, self._terms, 3)[..., 1:]
            for single_smallest in (smallest, lightest)
        ]
        places = [
            single_smallest.x[:, : 2 * self._webs].reshape(-1, self._webs, 2)
            for single_smallest in (smallest, lightest)
        ]
        prices = lightest.z[:, self._webs]
        return [
            Stages(p, p2, vectors_of(terms), vectors_of(terms2), price)
            for p, p2, terms, terms2, price in zip(*places, *duals, prices, strict=True)
        ]
