"""Counterweights of lattices and catalogues to a hundredth, a thousandth and a ten thousandth, beside SCIP and HiGHS.

``python -m tests.benchmarks.lattices [--limit 60]`` prints seconds of the processor and the gap at their end, of each
solver and gap. SCIP has cones. HiGHS has none: lengths are those of a polygon of 128 sides about the circle. It is
short by 3e-4 at most, so that its objective is a little less than that of its set. Gaps are shares of the objective
without counterweights.
"""

import argparse
import time
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import lil_matrix

from optimizer.choices.catalogue_options import stock
from optimizer.choices.discrete.options import Options
from optimizer.optimize import optimize
from optimizer.program.statement import Statement
from schemas.request.requests import OptimizeRequest
from tests.benchmarks.discrete import choice
from tests.choices.any_mass import of_any_mass
from tests.choices.scip import Chosen, scip
from tests.choices.test_ample import machine

GAPS = (1e-2, 1e-3, 1e-4)
#: options of all webs up to which either is asked: of more their first program alone takes minutes
_OF_CONES, _OF_POLYGONS = 5_000, 1_000
#: sides of the polygons of HiGHS
_SIDES = 128


class Ended(NamedTuple):
    """Where a solver ended: seconds of the processor, gap over the yardstick."""

    seconds: float
    gap: float

    def __str__(self) -> str:
        return f"{self.seconds:7.2f} s to {self.gap:.1e}"


def in_reach(webs: int, holes: int, masses: int) -> dict[str, Any]:
    """Counterweights that reach what no masses undercut: 12 kg, where 2 kg are too small."""
    body = choice(webs, holes, masses=masses)
    for web in body["machine"]["webs"]:
        web["max_mass_kg"] = 12.0
    body["machine"]["catalogue"] = {"masses_kg": [12.0 * n / masses for n in range(1, masses + 1)]}
    return body


def opposed(step_kg: float, step_deg: float) -> dict[str, Any]:
    """Four opposed throws with steps."""
    body = {**machine(), "catalogue": {"mass_step_kg": step_kg, "angle_step_deg": step_deg}}
    return {"machine": body, "objective": {"moment_weight": 1.0 / 3.0}}


CASES = {
    "4 webs, 64 masses x 12 angles": in_reach(4, 12, 64),
    "8 webs, 4 masses x 12 angles": in_reach(8, 12, 4),
    "8 webs, 4 masses x 12 angles, too small": choice(8, 12, masses=4),
    "8 webs, 10 kg x 15 degrees": opposed(10.0, 15.0),
    "8 webs, 0.5 kg x 5 degrees": opposed(0.5, 5.0),
}


def highs(statement: Statement, options: Options, relative_gap: float, yardstick: float, time_limit_s: float) -> Chosen:
    """One program without ceilings and counts, in units of its yardstick."""
    norms, slots = statement.norms, options.slots
    assert not statement.ceilings.names
    effect = norms.influence[:, :, None] * options.unbalance / yardstick
    taken, lengths = int(np.sum(options.exists)), norms.constant.size
    count = taken + lengths + int(statement.group[-1]) + 1
    rows = slots + _SIDES * lengths + statement.floor.size
    left, low, high = lil_matrix((rows, count)), np.full(rows, -np.inf), np.zeros(rows)
    number = np.cumsum(options.exists.ravel()).reshape(options.exists.shape) - 1
    for k in range(slots):
        left[k, number[k][options.exists[k]]] = 1.0
        low[k] = high[k] = 1.0
    row = slots
    for j in range(lengths):
        for angle in np.linspace(0.0, 2.0 * np.pi, _SIDES, endpoint=False):
            turn = np.exp(-1j * angle)
            left[row, number[options.exists]] = (turn * effect[j][options.exists]).real
            left[row, taken + j], high[row] = -1.0, -(turn * norms.constant[j] / yardstick).real
            row += 1
    for r, floor in enumerate(statement.floor.tolist()):
        left[row, taken + np.flatnonzero(statement.row == r)] = 1.0
        left[row, taken + lengths + statement.group[r]], high[row] = -1.0, -floor / yardstick
        row += 1
    cost = np.zeros(count)
    cost[taken + lengths :] = 1.0
    whole = np.zeros(count)
    whole[:taken] = 1
    bounds = Bounds(np.zeros(count), np.where(whole > 0, 1.0, np.inf))
    # its gap is relative to its objective
    solution = milp(
        cost, integrality=whole, bounds=bounds, constraints=LinearConstraint(left.tocsr(), low, high),
        options={"time_limit": time_limit_s, "mip_rel_gap": relative_gap},
    )  # fmt: skip
    objective = np.nan if solution.fun is None else solution.fun * yardstick
    bound = -np.inf if solution.mip_dual_bound is None else solution.mip_dual_bound * yardstick
    return Chosen(objective, bound, int(solution.mip_node_count or 0))


def ours(body: dict[str, Any], gap: float, limit_s: float) -> tuple[Ended, float, float]:
    """Where the service ends, its objective over the yardstick, and its kilograms."""
    request = OptimizeRequest.model_validate(body | {"accuracy": {"relative_gap": gap, "time_limit_s": limit_s}})
    began = time.process_time()
    proof = (answer := optimize(request)).certificate
    seconds = time.process_time() - began
    assert proof is not None
    assert proof.relative_gap is not None
    return Ended(seconds, proof.relative_gap), proof.objective / proof.yardstick, answer.total_mass_kg or 0.0


def main(limit_s: float) -> None:
    for name, body in CASES.items():
        print(name)
        request = OptimizeRequest.model_validate(body)
        free, size = of_any_mass(request)
        program, options = free.program.subset(0), stock(request.machine).options
        ours(body, GAPS[0], limit_s)
        for gap in GAPS:
            here, objective, mass = ours(body, gap, limit_s)
            print(f"  {gap:.0e}  ours  {here}, objective {objective:.5f}, {mass:.1f} kg", flush=True)
        for label, solver, most in (("SCIP ", scip, _OF_CONES), ("HiGHS", highs, _OF_POLYGONS)):
            if np.sum(options.exists) > most:
                print(f"         {label} is not asked: more than {most} options")
                continue
            for gap in GAPS:
                began = time.process_time()
                bound = solver(program, options, gap, size, limit_s)
                there = Ended(time.process_time() - began, (bound.objective - bound.lower_bound) / size)
                print(f"  {gap:.0e}  {label} {there}, objective {bound.objective / size:.5f}", flush=True)
                if there.gap > gap:
                    # nor does it come any closer in the same time
                    break


if __name__ == "__main__":
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--limit", type=float, default=60.0, help="seconds for each")
    main(reader.parse_args().limit)
