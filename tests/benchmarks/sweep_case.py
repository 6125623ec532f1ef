"""The sweep that is timed: masses and geometry of the 2D12 with eight places for counterweights, limits active."""

import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from optimizer.formulation.goals import cone_program
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.registry import prepare
from optimizer.program.statement import Statement
from optimizer.studies.sweep.designs import axis_values
from schemas.base.variation import with_fields
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.benchmarks.cases import eight_webs

#: largest mass of a counterweight, kg: below what most of the designs call for
_MAX_MASS = 2.5
_AXES = [
    {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "start": 260, "stop": 400},
    {"path": "/machine/throws/1/rows/0/reciprocating_mass_kg", "start": 180, "stop": 300},
    {"path": "/machine/throws/1/position_m", "start": 0.15, "stop": 0.25},
    {"path": "/machine/throws/0/crank_radius_m", "start": 0.12, "stop": 0.16},
    {"path": "/machine/webs/0/max_mass_kg", "start": 2, "stop": 6},
    {"path": "/machine/webs/7/max_mass_kg", "start": 2, "stop": 6},
    {"path": "/machine/webs/3/counterweight_radius_m", "start": 0.2, "stop": 0.3},
]


def sweep(samples: int, task: str = "optimize", **more: object) -> SweepRequest:
    """So many designs, a Latin hypercube."""
    machine = json.loads(eight_webs())["machine"]
    for web in machine["webs"]:
        web["max_mass_kg"] = _MAX_MASS
    body = {"task": task, "base": {"machine": machine}, "axes": _AXES, "design": "latin_hypercube", "samples": samples}
    return SweepRequest.model_validate({**body, "seed": 6, **more})


@dataclass(frozen=True)
class Program:
    """One design as matrices of order one, for any solver.

    p_k in the unit disc is the share of the reach of web k; peaks |constant_j + influence_j p| are summed.
    """

    statement: Statement
    constant: Real  # (J, 2)
    influence: Real  # (J, K)
    mass: Real  # (K,) share of the mass of all webs at full reach
    unit: float  # of the peaks
    mass_unit: float  # kg
    share: float  # how far above the smallest value an optimum may be, scaled

    @property
    def reach(self) -> Real:
        return self.statement.limits.reach

    def unbalance(self, p: Real) -> Complex:
        """Unbalance of shares (K, 2), within the limits, kg m (K,)."""
        return self.statement.limits.into(self.reach * (p[:, 0] + 1j * p[:, 1]))


def programs(request: SweepRequest, numbers: Iterable[int]) -> list[Program]:
    """The programs of some designs, each formulated by itself."""
    columns = {
        target.path: values
        for target, values in zip(request.targets, axis_values(request, 0, request.total), strict=True)
    }
    designs = (
        with_fields(request.base, {path: float(values[number]) for path, values in columns.items()})
        for number in numbers
    )
    return [_program(design) for design in designs]


def _program(request: OptimizeRequest) -> Program:
    scene = prepare(request, ("residual",))
    statement = cone_program(request.machine, request.objective, scene.responses, scene.omega_squared)
    constant, influence, limits = statement.norms.constant, statement.norms.influence, statement.limits
    unit, mass = float(np.sum(np.abs(constant))), limits.max_mass
    rest = float(statement.objective(np.zeros(limits.radius.shape, complex)))
    return Program(
        statement,
        np.stack([constant.real, constant.imag], axis=-1) / unit,
        influence * limits.reach / unit,
        mass / np.sum(mass),
        unit,
        float(np.sum(mass)),
        request.accuracy.relative_gap * rest / unit,
    )
