"""A machine and the outputs about it: the beginning of every request about one machine."""

from typing import Literal

from pydantic import Field

from schemas.answer.foundation import FoundationOrders
from schemas.answer.outputs import OutputNames
from schemas.base.angles import Angles
from schemas.base.model import Model
from schemas.machine.machine import Machine


class Fidelity(Model):
    """How closely effects are simulated."""

    kinematics: Literal["exact", "order_2"] = Field(
        "exact",
        description="exact slider-crank kinematics, or its series cut off after the second order",
        examples=["exact"],
    )
    shaft: Literal["simple_spans", "continuous"] = Field(
        "simple_spans",
        description="main bearings: every span simply supported, or a continuous shaft on rigid bearings",
        examples=["simple_spans"],
    )


class Scene(Model):
    """A machine and what is asked about it; decides which effects are simulated."""

    machine: Machine = Field(
        description="the machine",
        examples=[
            {
                "kind": "reciprocating",
                "speed_rpm": 500,
                "throws": [
                    {
                        "position_m": 0.0,
                        "crank_radius_m": 0.14,
                        "crank_angle_deg": 0,
                        "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 100}],
                    }
                ],
            }
        ],
    )
    outputs: OutputNames = Field(("residual",), description="what the answer shall hold", examples=[["residual"]])
    foundation_orders: FoundationOrders = Field(
        (1, 2, 3, 4, 5, 6), description="orders of the output foundation_loads, first to sixth", examples=[[1, 2]]
    )
    angles: Angles = Field(Angles(), description="samples of the shaft angle", examples=[{"step_deg": 1}])
    fidelity: Fidelity = Field(Fidelity(), description="how closely to simulate", examples=[{"kinematics": "exact"}])
