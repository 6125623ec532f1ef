"""Multipliers of the program by name and in the units of the answer: the proof that leaves the house.

The program is in mass-radius products, forces over omega^2. A multiplier of the objective is the same in either; one
of the mass, or of a ceiling alone, is per newton and so divided by omega^2. Ceilings are over omega^2 of the scenario
whose response they limit, and all else is over that of the unchanged machine. Webs that cannot carry anything have
no multipliers of their own, so none is missing where the program went without them.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, Literal

import numpy as np

from optimizer.formulation.limits import largest_mass
from optimizer.numerics.arrays import Complex, Real, Reals, any_true
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers, budget_price, normalised, nothing_proven, together
from optimizer.program.statement import Statement
from schemas.answer.proof import BoundMultipliers
from schemas.machine.machine import Machine

#: |y| <= lambda holds for the printed numbers too, whatever the rounding of the division by omega^2
_INSIDE = 1.0 - 4 * float(np.finfo(float).eps)

Bounded = Literal["objective", "mass", "parameter"]


@record(frozen=True)
class PhysicalMultipliers:
    """Multipliers in N, N m and kg; leading axes are programs."""

    term: Complex  # (..., J)
    row: Real  # (..., rows)
    ceiling: Complex  # (..., I)
    budget: Real  # (...)

    def of_groups(self, statement: Statement, scale: Real | None) -> "PhysicalMultipliers":
        """Those of the groups as they are, from those of a statement whose groups are multiplied by a scale (groups,).

        So the rows of a goal, or of a scenario, sum to its price, and a bound is evaluated from what is printed alone.
        """
        if scale is None:
            return self
        of_row = scale[statement.group]
        return PhysicalMultipliers(self.term * of_row[statement.row], self.row * of_row, self.ceiling, self.budget)

    def subset(self, program: int) -> "PhysicalMultipliers":
        """Those of one program of one leading axis."""
        return PhysicalMultipliers(self.term[program], self.row[program], self.ceiling[program], self.budget[program])


#: omega^2 by scenario, rad^2/s^2
Speeds = Mapping[str | None, float]


def physical(
    statement: Statement, multipliers: Multipliers, bounded: Bounded, omega_squared: Reals, speeds: Speeds | None = None
) -> PhysicalMultipliers:
    """Multipliers of a bound in the units of the answer.

    Parameters
    ----------
    statement : (...) programs, over omega^2.
    bounded : "objective": in units of the objective, the rows sum to 1; "mass": in kg; "parameter": a plain number.
    omega_squared : (...) rad^2/s^2.
    speeds : of all scenarios, where there are any.
    """
    (result,) = physical_bounds(statement, {bounded: multipliers}, omega_squared, speeds)
    return result


def _squares(scenarios: Iterable[str | None], speeds: Speeds) -> Real:
    """omega^2 of the scenario of each (...) rad^2/s^2."""
    return np.array([speeds[scenario] for scenario in scenarios])


def physical_bounds(
    statement: Statement,
    bounds: Mapping[Bounded, Multipliers],
    omega_squared: Reals,
    speeds: Speeds | None = None,
) -> Iterator[PhysicalMultipliers]:
    """The same of several bounds on the same programs at once, in their order."""
    scenarios = statement.ceilings.scenarios
    over = omega_squared / _squares(scenarios, speeds) if speeds and scenarios else None
    stack, ends = together(bounds.values()), statement.limits.budget_ends
    priced, factor = np.zeros(stack.row.shape[:-1], bool), np.empty(stack.row.shape[:-1])
    factor[:] = 1.0 / omega_squared
    for n, name in enumerate(bounds):
        priced[n] = name == "objective"
    statement.flat.printed(priced, factor, _INSIDE, stack.parts)
    spent, nothing = np.count_nonzero(ends), np.zeros(ends.shape)
    for n, (name, multipliers) in enumerate(bounds.items()):
        if not spent:
            budget = nothing
        elif name == "objective":
            budget = budget_price(statement, stack.subset(n), 0.0) * omega_squared
        else:
            budget = budget_price(statement, multipliers, 1.0 if name == "mass" else 0.0)
        ceiling = stack.ceiling[n] if over is None else stack.ceiling[n] * over
        yield PhysicalMultipliers(stack.term[n], stack.row[n], ceiling, budget)


def conflict(statement: Statement, excess: Multipliers, omega_squared: Reals) -> PhysicalMultipliers:
    """Multipliers that prove that the ceilings cannot be kept, in 1/N and 1/(N m).

    Parameters
    ----------
    excess : of the program whose terms and rows are the ceilings, each over its size.
    """
    scale = 1.0 / statement.ceilings.size
    row = np.maximum(excess.row, 0.0) * scale
    ceiling = _no_longer(excess.term * scale, row)
    alone = replace(nothing_proven(statement), ceiling=ceiling)
    per_newton = 1.0 / np.asarray(omega_squared)[..., None]
    price = budget_price(statement, alone, 0.0)
    return PhysicalMultipliers(alone.term, row * per_newton, ceiling * per_newton, price)


def implied_max_mass(machine: Machine, most: Real) -> list[dict[str, float]]:
    """Limits (N, K) that the proofs of N designs count with, in place of those of the machine, kg."""
    smaller = most < largest_mass(machine)
    if not any_true(smaller):
        return [{} for _ in range(len(most))]
    return [
        {web.name: mass for web, mass, counts in zip(machine.webs, *of_design, strict=True) if counts}
        for of_design in zip(most.tolist(), smaller.tolist(), strict=True)
    ]


def bound_multipliers(statement: Statement, multipliers: PhysicalMultipliers) -> BoundMultipliers:
    """Multipliers of a bound on one program (no leading axes of theirs) by the names of its terms, rows, ceilings."""
    return BoundMultipliers.model_validate(fields_by_name(statement, multipliers))


def fields_by_name(statement: Statement, multipliers: PhysicalMultipliers) -> dict[str, Any]:
    """The same before they are validated: the validation of a whole takes half the time of one of each part."""
    terms, rows = statement.names
    return {
        "terms": [
            {
                "response": term.response,
                "part": term.part,
                "row": rows[row],
                "angle_deg": term.angle_deg,
                "scenario": term.scenario,
                "x": part.real,
                "y": part.imag,
                "share": term.share,
            }
            for term, row, y in zip(terms, statement.row.tolist(), multipliers.term.tolist(), strict=True)
            for part in (y if term.share is None else y * term.share,)
        ],
        **_shared(rows, statement, multipliers),
    }


def conflict_multipliers(statement: Statement, multipliers: PhysicalMultipliers) -> BoundMultipliers:
    """Multipliers of :func:`conflict`, one program: its rows are the ceilings."""
    names = statement.ceilings.names
    return BoundMultipliers.model_validate({"terms": (), **_shared(names, statement, multipliers)})


def excess_multipliers(excess: Statement, multipliers: Multipliers, scales: Real, speeds: Speeds) -> BoundMultipliers:
    """Multipliers that prove that ceilings cannot be kept, by the program of their excess: a row for each ceiling.

    Parameters
    ----------
    scales : (rows,) what each ceiling is divided by in that program.
    speeds : of all scenarios, or of the unchanged machine.
    """
    usable, _ = normalised(excess, multipliers)
    names = excess.names
    squares = np.ones_like(scales)
    # all terms of a row are of one scenario
    squares[excess.row] = _squares((term.scenario for term in names.terms), speeds)
    row = usable.row / scales / squares
    terms = _no_longer(usable.term / (scales * squares)[excess.row], row[excess.row])
    price = budget_price(excess, usable, 0.0)
    return BoundMultipliers.model_validate(
        {
            "terms": (),
            "rows": tuple({"name": name, "value": value} for name, value in zip(names.rows, row.tolist(), strict=True)),
            "budget": float(price),
            "ceilings": tuple(
                {
                    "response": term.response,
                    "part": "co",
                    "angle_deg": term.angle_deg,
                    "scenario": term.scenario,
                    "x": p.real,
                    "y": p.imag,
                }
                for term, p in zip(names.terms, terms.tolist(), strict=True)
            ),
        }
    )


def _no_longer(vectors: Complex, allowed: Real) -> Complex:
    """Vectors that are no longer than allowed, whatever the rounding of what is done to both."""
    size, allowed = np.abs(vectors), allowed * _INSIDE
    return vectors * np.where(size > allowed, allowed / np.where(size > 0, size, 1.0), 1.0)


def _shared(names: tuple[str, ...], statement: Statement, multipliers: PhysicalMultipliers) -> dict[str, Any]:
    """What every bound has: rows of these names, a budget and ceilings."""
    ceilings = statement.ceilings
    shared = {
        "rows": [{"name": name, "value": value} for name, value in zip(names, multipliers.row.tolist(), strict=True)],
        "budget": float(multipliers.budget),
        "ceilings": (),
    }
    if ceilings.names:
        nothing = (None,) * len(ceilings.names)
        angles, scenarios = ceilings.angles_deg or nothing, ceilings.scenarios or nothing
        shared["ceilings"] = [
            {"response": name, "part": "co", "angle_deg": angle, "scenario": scenario, "x": p.real, "y": p.imag}
            for name, angle, scenario, p in zip(
                ceilings.names, angles, scenarios, multipliers.ceiling.tolist(), strict=True
            )
        ]
    return shared
