"""Cheaper choices beside the best one."""

from typing import Literal

from pydantic import Field

from schemas.answer.counterweights import FittedShaft, WebCounterweights
from schemas.base.model import Model
from schemas.base.quantities import Fraction, Kilograms

Cheaper = Literal["mass", "pieces", "sizes"]


class Alternative(Model):
    """A choice that is cheaper than the best one, and costs no more of the objective than an allowance."""

    minimised: Cheaper = Field(
        description="mass: total mass; pieces: number of counterweights; sizes: number of different masses",
        examples=["pieces"],
    )
    allowance: Fraction = Field(
        description="what the objective may be above that of the answer, as a share of it", examples=[0.02]
    )
    objective: float = Field(description="objective of this choice, recomputed", examples=[41365.2])
    total_mass_kg: Kilograms = Field(
        description="total mass of all shafts, fixed counterweights included", examples=[85.5]
    )
    pieces: int = Field(description="number of counterweights that are chosen", examples=[2])
    sizes: int = Field(description="number of different masses among these", examples=[2])
    lower_bound: float | None = Field(
        description="certified: no choice within the allowance has less mass [kg], or fewer counterweights or sizes;"
        " null if nothing is proven",
        examples=[2.0],
    )
    counterweights: WebCounterweights
    balance_shafts: tuple[FittedShaft, ...] = Field(
        (), description="what the balance shafts carry beside them", examples=[[]]
    )
