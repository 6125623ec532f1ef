"""A component of OpenMDAO: limits of a machine in, the certified peak out, with exact gradients.

    python balance.py

needs OpenMDAO, a service at 127.0.0.1:8000 and `counterweight.py` (examples/client) beside this file.

The certificate of an optimum holds its gradients already. The shadow price of a limit is what the peak falls by for
each unit that the limit is loosened. The multiplier of a response is what the peak rises by for each unit of that
response, as it is weighed. An unbalance of the shaft itself moves the responses in proportion. Neither needs another
optimum. Where a price has two sides (a kink, where a limit just begins to bind), the gradient is that of one of them,
and an outer optimiser may stall there.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from math import pi
from typing import Any

import openmdao.api as om

#: request -> answer, of POST /v1/optimize
Ask = Callable[[dict[str, Any]], dict[str, Any]]


class Balance(om.ExplicitComponent):  # type: ignore[misc]
    """Best counterweights of a machine.

    Inputs: ``max_mass`` [kg] of every web, ``unbalance`` [kg m], x and y of every one of `machine.unbalances`.
    Outputs: ``peak`` [N], the objective, and ``mass`` [kg] of all counterweights.
    """

    def initialize(self) -> None:
        self.options.declare("request", types=dict, desc="of POST /v1/optimize; webs with max_mass_kg, a moment_weight")
        self.options.declare("ask", desc="what sends it and returns the answer")

    def setup(self) -> None:
        machine = self.options["request"]["machine"]
        webs, unbalances = machine["webs"], machine.get("unbalances", [])
        self._names = [web["name"] for web in webs]
        self._places = [unbalance["position_m"] for unbalance in unbalances]
        self.add_input("max_mass", val=[web["max_mass_kg"] for web in webs], units="kg")
        self.add_output("peak", units="N")
        self.add_output("mass", units="kg")
        self.declare_partials("peak", "max_mass")
        if unbalances:
            vectors = [[unbalance.get("x_kg_m", 0.0), unbalance.get("y_kg_m", 0.0)] for unbalance in unbalances]
            self.add_input("unbalance", val=vectors, units="kg*m")
            self.declare_partials("peak", "unbalance")

    def compute(self, inputs: Any, outputs: Any) -> None:
        request = deepcopy(self.options["request"])
        for web, most in zip(request["machine"]["webs"], inputs["max_mass"], strict=True):
            web["max_mass_kg"] = float(most)
        if self._places:
            for unbalance, (x, y) in zip(request["machine"]["unbalances"], inputs["unbalance"], strict=True):
                unbalance["x_kg_m"], unbalance["y_kg_m"] = float(x), float(y)
        self._answer = self.options["ask"](request)
        if self._answer["status"] != "optimal":
            raise om.AnalysisError(f"no optimum: {self._answer['status']}")
        outputs["peak"] = self._answer["certificate"]["objective"]
        outputs["mass"] = self._answer["total_mass_kg"]

    def compute_partials(self, inputs: Any, partials: Any) -> None:
        prices = dict.fromkeys(self._names, 0.0)
        for price in self._answer["shadow_prices"]:
            if price["limit"] == "max_mass":
                prices[price["web"]] = price["value"]
        partials["peak", "max_mass"] = [[-prices[name] for name in self._names]]
        if self._places:
            partials["peak", "unbalance"] = [[slope for place in self._places for slope in self._slopes(place)]]

    def _slopes(self, place: float) -> tuple[float, float]:
        """What the peak rises by for each kg m in a plane, along x and along y."""
        request = self.options["request"]
        square = (request["machine"]["speed_rpm"] * pi / 30) ** 2
        arm = request["objective"]["moment_weight"] * (place - self._answer["reference_plane_m"])
        x = y = 0.0
        for term in self._answer["certificate"]["multipliers"]["objective"]["terms"]:
            # an unbalance turns with the shaft
            if term["part"] == "co":
                lever = square * (1.0 if term["response"] == "force" else arm)
                x, y = x + lever * term["x"], y + lever * term["y"]
        return x, y


def problem(request: dict[str, Any], ask: Ask, kilograms: float) -> om.Problem:
    """So many kilograms of limits, shared out among the webs so that the peak is smallest."""
    count = len(request["machine"]["webs"])
    problem = om.Problem(reports=False)
    problem.model.add_subsystem("balance", Balance(request=request, ask=ask), promotes=["*"])
    together = om.ExecComp(
        "together = sum(max_mass)", max_mass={"shape": count, "units": "kg"}, together={"units": "kg"}
    )
    problem.model.add_subsystem("limits", together, promotes=["*"])
    problem.model.set_input_defaults("max_mass", val=[kilograms / count] * count, units="kg")
    problem.model.add_design_var("max_mass", lower=1.0, upper=kilograms, ref=kilograms / count)
    problem.model.add_constraint("together", upper=kilograms, ref=kilograms)
    problem.model.add_objective("peak", ref=1e4)
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-9, disp=False)
    problem.setup()
    return problem


def main() -> None:
    from counterweight import Service

    service = Service()
    request = service.example("2d12")
    shared = problem(request, service.optimize, 160.0)
    shared.run_driver()
    print("limits, kg:", shared.get_val("max_mass").round(3), "peak, N:", shared.get_val("peak").round(1))


if __name__ == "__main__":
    main()
