"""The list of outputs and effects: the outputs, the effects behind them, the inputs that they read."""

from pydantic import Field

from schemas.base.model import Model


class EffectEntry(Model):
    """A physical effect."""

    name: str = Field(description="name of the effect", examples=["gas"])
    meaning: str = Field(description="what it simulates", examples=["four-process cycle in every chamber"])
    needs: tuple[str, ...] = Field(description="effects whose results it uses", examples=[["kinematics"]])
    inputs: tuple[str, ...] = Field(
        description="fields of the request that it reads beyond masses and geometry",
        examples=[["machine.throws.rows.cylinder"]],
    )


class OutputEntry(Model):
    """An output that a request can ask for."""

    name: str = Field(description="name of the output", examples=["gas"])
    meaning: str = Field(description="what it holds", examples=["pressures and gas forces of every row"])
    needs: tuple[str, ...] = Field(
        description="effects that are simulated for it, in the order in which they run; "
        "those that a machine does not have are left out",
        examples=[["kinematics", "gas"]],
    )
    inputs: tuple[str, ...] = Field(
        description="fields of the request that these effects read beyond masses and geometry",
        examples=[["machine.throws.rows.connecting_rod", "machine.throws.rows.cylinder"]],
    )


class EffectCatalogue(Model):
    """All outputs and all effects."""

    outputs: tuple[OutputEntry, ...] = Field(description="the outputs", examples=[[{"name": "gas"}]])
    effects: tuple[EffectEntry, ...] = Field(
        description="the effects, each after those that it needs", examples=[[{"name": "kinematics"}]]
    )
