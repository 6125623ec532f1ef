"""The cone program, once and readably, in cvxpy: what the tests and the accuracy ladder hold the others against.

In scaled variables a web's unbalance is u_k = U_k e^{j c_k} (x_k + j s_k y_k): U_k its reach, c_k the
middle of its sector and s_k the sine of its half-angle, so that x, y are of order one however thin
the sector or small the limit (docs/mathematics.md section 4).

    minimise    sum_g level_g                     (stage "objective")
                mass @ fraction                   (stage "mass")
    subject to  |C_j + M_j (x, y)| <= t_j
                membership t + floor <= level_g   for every row of group g
                sum_g level_g <= target           (stage "mass")
                |C_i + M_i (x, y)| <= cap_i       ceilings
                |(x_k, s_k y_k)| <= fraction_k <= 1
                |y_k| cos B_k <= x_k              sectors
                budget @ fraction <= 1            total mass
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.scaled_program import ScaledData, ScaledSolution, Shape

if TYPE_CHECKING:
    import cvxpy as cp


class ConeProgram:
    """A compiled program of one shape. Not for two threads at once."""

    def __init__(self, shape: Shape) -> None:
        """Compile.

        Raises
        ------
        RuntimeError
            if the program does not follow cvxpy's rules for parameters (DPP), in which case it
            would be compiled anew for every machine.
        """
        import cvxpy as cp

        webs, terms, rows = shape.webs, len(shape.rows), len(shape.groups)
        self.shape = shape
        self._parameters: dict[str, cp.Parameter] = {}

        x, y = cp.Variable(webs), cp.Variable(webs)
        fraction, norm = cp.Variable(webs), cp.Variable(terms)
        disc = cp.vstack([x, cp.multiply(self._parameter("sine", webs), y)])
        limits = [cp.SOC(fraction, disc, axis=0), fraction <= 1]
        if shape.sectors:
            slack = self._parameter("slack", webs)
            limits.append(cp.multiply(self._parameter("cosine", webs, nonneg=True), cp.abs(y)) <= x + slack)
        if shape.budget:
            limits.append(self._parameter("budget", webs) @ fraction <= 1)

        place = cp.hstack([x, y])
        vectors = cp.reshape(self._parameter("matrix", (2 * terms, 2 * webs)) @ place, (2, terms), order="C")
        terms_cone = cp.SOC(norm, self._parameter("constant", (2, terms)) + vectors, axis=0)
        ceilings = []
        if shape.ceilings:
            count = shape.ceilings
            vectors = cp.reshape(
                self._parameter("ceiling_matrix", (2 * count, 2 * webs)) @ place, (2, count), order="C"
            )
            cap = self._parameter("ceiling_cap", count)
            ceilings = [cp.SOC(cap, self._parameter("ceiling_constant", (2, count)) + vectors, axis=0)]

        membership = (np.arange(rows)[:, None] == np.array(shape.rows, dtype=int)[None, :]).astype(float)
        total = membership @ norm + self._parameter("floor", rows)
        groups = shape.groups[-1] + 1
        level: cp.Expression = cp.Variable(groups)
        objective = cp.sum(level)
        if shape.stage == "mass":
            objective = self._parameter("mass", webs) @ fraction
            target = self._parameter("target", (1,))
            if groups > 1:
                limits.append(cp.sum(level) <= target)
            else:
                level = target
        rows_below = total <= level[list(shape.groups)]
        self._problem = cp.Problem(cp.Minimize(objective), [*limits, terms_cone, *ceilings, rows_below])
        if not self._problem.is_dcp(dpp=True):
            raise RuntimeError("the cone program must be DPP, or it would be compiled anew for every machine")
        self._variables = (x, y)
        self._duals = (rows_below, terms_cone, ceilings[0] if ceilings else None)

    def _parameter(self, name: str, shape: Any, **attributes: Any) -> "cp.Parameter":
        import cvxpy as cp

        self._parameters[name] = cp.Parameter(shape, name=name, **attributes)
        return self._parameters[name]

    def solve(self, data: ScaledData, tolerance: float) -> ScaledSolution | None:
        """Solve for one set of data; None if the solver has no point to offer.

        The solver's verdict is passed on, not believed.
        """
        import cvxpy as cp

        for name, parameter in self._parameters.items():
            parameter.value = getattr(data, name)
        options = {"tol_gap_abs": tolerance, "tol_gap_rel": tolerance, "tol_feas": tolerance}
        # the steps of Problem.solve, without writing the result into the shared variables and
        # without its warnings: the status is read here, and judged by the certificate
        compiled, chain, inverse = self._problem.get_problem_data(cp.CLARABEL, enforce_dpp=True, solver_opts=options)
        raw = chain.solve_via_data(self._problem, compiled, False, False, options)
        solution = chain.invert(raw, inverse)
        if not solution.primal_vars or solution.status in (cp.INFEASIBLE, cp.UNBOUNDED):
            return None
        x, y = (np.atleast_1d(solution.primal_vars[variable.id]) for variable in self._variables)
        rows, terms, ceilings = self._duals
        if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
            return None
        return ScaledSolution(
            x=x,
            y=y,
            row=np.atleast_1d(solution.dual_vars[rows.id]),
            term=_vector_duals(solution, terms, len(self.shape.rows)),
            ceiling=_vector_duals(solution, ceilings, self.shape.ceilings),
            solver_status=str(solution.status),
        )


def _vector_duals(solution: Any, cone: Any, count: int) -> Complex:
    """Multipliers p of |a| <= t as complex numbers: the cone's dual is (|p|, -p)."""
    if cone is None:
        return np.zeros(0, complex)
    _, real, imaginary = np.reshape(solution.dual_vars[cone.id], (count, 3)).T
    return -(real + 1j * imaginary)
