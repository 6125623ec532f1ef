"""Machines whose fronts are known in closed form, and short ways to ask for fronts."""

from dataclasses import replace
from typing import Any

from optimizer.outputs.registry import prepare
from optimizer.solve.uncertain_program import Robust
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.pareto.trade import Trade, trade
from optimizer.studies.pareto.trades import needed
from schemas.base.responses import PAIR
from schemas.front.pareto import ParetoAnswer, ParetoFront, ParetoPoint, ParetoRequest
from tests.optimize.machines import machine, row, throw, web

RPM = 600.0
OMEGA_SQUARED = (RPM * 3.141592653589793 / 30.0) ** 2


def ask(body: dict[str, Any], **more: Any) -> ParetoAnswer:
    return pareto(ParetoRequest.model_validate({"machine": body, "points": 9, **more}))


def trade_of(request: ParetoRequest) -> Trade:
    """What a request trades, within its own limits."""
    scene, task = prepare(request, ("residual",)), needed(request, PAIR, request.machine)
    return trade(Robust(task, replace(scene, objective=task.objective), task.demand).goals().program)


def front(body: dict[str, Any], **more: Any) -> ParetoFront:
    """The front of the machine's own budget."""
    answer = ask(body, **more)
    assert len(answer.fronts) == 1
    assert answer.status == answer.fronts[0].status
    return answer.fronts[0]


def traded(point: ParetoPoint) -> tuple[float, float]:
    return point.weighted_force_peak_N, point.weighted_moment_peak_Nm


def below_a_corner(force: float, moment: float, pareto_front: ParetoFront, slack: float = 0.0) -> bool:
    """Whether a force and a moment are where the front proves that no counterweights are.

    slack : share of the scale by which both must be below the corner to count.
    """
    assert pareto_front.scale is not None
    force, moment = force + slack * pareto_front.scale.force_N, moment + slack * pareto_front.scale.moment_Nm
    return any(
        force < point.certificate.force_N and moment < point.certificate.moment_Nm for point in pareto_front.points
    )


def straight() -> dict[str, Any]:
    """A turning mass of 1 kg m in the plane of moments and a web 2 m beside it.

    Analytic: with u = -x the peaks are F = (1 - x) and M = 2 x, times omega^2: the line F + M/2 = 1.
    """
    return machine([throw(0.0, 0.0, [], radius=0.1, rotating=10.0)], [web("a", 2.0, 100.0, 0.2)], reference_plane_m=0.0)


#: radius of the disc of unbalances and distance of the two targets from its middle, kg m
RHO, TARGET = 0.5, 1.0


def circular() -> dict[str, Any]:
    """Two turning masses 1 m apart and one web that is too small.

    Analytic: f = u - d and g = u - jd with |u| <= rho < d/sqrt 2, so that the front is the arc u = rho e^{j phi},
    0 <= phi <= 90 degrees: F = sqrt(d^2 + rho^2 - 2 d rho cos phi), M the same with sin phi, times omega^2.
    """
    throws = [
        throw(0.0, 135.0, [], radius=0.1, rotating=10.0 * TARGET * 2**0.5),
        throw(1.0, 270.0, [], radius=0.1, rotating=10.0 * TARGET),
    ]
    return machine(throws, [web("a", 1.0, RHO / 0.2, 0.2)], reference_plane_m=0.0)


def single_row() -> dict[str, Any]:
    """A row of 100 kg and a web in its plane: half the mass is all that counterweights can balance."""
    return machine([throw(0.0, 0.0, [row(0.0, 100.0)])], [web("a", 0.0, 1000.0)])


def four_webs(**more: Any) -> dict[str, Any]:
    """A machine with two cranks and webs too small for both peaks."""
    throws = [throw(0.0, 0.0, [row(0.0, 60.0)], rotating=10.0), throw(0.5, 100.0, [row(30.0, 40.0)], rotating=20.0)]
    webs = [web("a", -0.2, 10.0), web("b", 0.2, 12.0), web("c", 0.3, 25.0), web("d", 0.7, 8.0)]
    return machine(throws, webs, **more)
