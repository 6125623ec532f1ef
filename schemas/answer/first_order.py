"""Force and moment of the first order, and what remains of them."""

from pydantic import Field

from schemas.answer.outputs import Order
from schemas.answer.proof import ResponseName
from schemas.base.model import Model
from schemas.base.quantities import (
    Degrees,
    NewtonMetres,
    Newtons,
)


class ForceEllipse(Model):
    """The first-order force over a turn: an ellipse, exact."""

    peak_N: Newtons = Field(description="largest force over a revolution, the major semi-axis", examples=[4997.4])
    minor_N: Newtons = Field(description="smallest force over a revolution, the minor semi-axis", examples=[0.0])
    major_axis_deg: Degrees = Field(description="direction of the major axis, 0 to 180", examples=[0.0])
    peak_x_N: Newtons = Field(description="largest x component over a revolution", examples=[4997.4])
    peak_y_N: Newtons = Field(description="largest y component over a revolution", examples=[0.0])
    co_rotating_N: Newtons = Field(description="magnitude of the phasor that turns with the shaft", examples=[2498.7])
    counter_rotating_N: Newtons = Field(
        description="magnitude of the phasor that turns against the shaft", examples=[2498.7]
    )


class MomentEllipse(Model):
    """The first-order moment over a turn: the couple in the plane of the forces, an ellipse, exact."""

    peak_Nm: NewtonMetres = Field(
        description="largest moment over a revolution, the major semi-axis", examples=[19494.0]
    )
    minor_Nm: NewtonMetres = Field(description="smallest moment over a revolution, the minor semi-axis", examples=[0.0])
    major_axis_deg: Degrees = Field(description="direction of the major axis, 0 to 180", examples=[0.0])
    peak_x_Nm: NewtonMetres = Field(description="peak of the horizontal couple, of the x forces", examples=[19494.0])
    peak_y_Nm: NewtonMetres = Field(description="peak of the vertical couple, of the y forces", examples=[0.0])
    co_rotating_Nm: NewtonMetres = Field(
        description="magnitude of the phasor that turns with the shaft", examples=[9747.0]
    )
    counter_rotating_Nm: NewtonMetres = Field(
        description="magnitude of the phasor that turns against the shaft", examples=[9747.0]
    )


class FirstOrder(Model):
    """First-order force and moment on the frame."""

    force: ForceEllipse = Field(description="force on the frame", examples=[{"peak_N": 4997.4}])
    moment: MomentEllipse = Field(
        description="moment about the reference plane, as a couple in the plane of the forces",
        examples=[{"peak_Nm": 19494.0}],
    )


class ResponsePeak(Model):
    """The peak of a response on the frame other than force and moment."""

    response: ResponseName = Field(description="the response, as its fields name it", examples=["moment"])
    label: str = Field(description="what it is called", examples=["moment"])
    unit: str = Field(description="unit of its peaks", examples=["N m"])
    peak: float = Field(description="its largest value", examples=[20110.0])


class ResponseChange(Model):
    """The same without and with counterweights, of the first order and of all."""

    response: ResponseName = Field(description="the response, as its fields name it", examples=["moment"])
    label: str = Field(description="what it is called", examples=["moment"])
    unit: str = Field(description="unit of its peaks", examples=["N m"])
    before: float = Field(description="peak of the first order without counterweights", examples=[20110.0])
    after: float | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)", examples=[6970.1]
    )
    turn_before: float | None = Field(
        None,
        description="peak of all orders without counterweights; null where the objective looks at the first alone",
        examples=[None],
    )
    turn_after: float | None = Field(
        None, description="with the counterweights; null likewise, and where there are none to show", examples=[None]
    )


class ResidualOrders(Model):
    """Orders 1 and 2 without and with counterweights, which change the first alone; closed forms."""

    before: tuple[Order, Order | None] = Field(
        description="without counterweights; the second is null where a row has no rod", examples=[[{"order": 1}, None]]
    )
    after: tuple[Order, Order | None] | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)",
        examples=[[{"order": 1}, None]],
    )


class TurnPeaks(Model):
    """Peaks of force and moment with all orders, each to 1e-8."""

    force_peak_N: Newtons = Field(description="largest force over a revolution", examples=[13010.2])
    moment_peak_Nm: NewtonMetres = Field(description="largest moment over a revolution", examples=[20110.0])


class TurnResidual(Model):
    """All orders without and with counterweights."""

    before: TurnPeaks = Field(description="without counterweights", examples=[{"force_peak_N": 13010.2}])
    after: TurnPeaks | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)",
        examples=[{"force_peak_N": 6970.1}],
    )


class Residual(Model):
    """First order without and with counterweights, and the second that they cannot change."""

    before: FirstOrder = Field(description="without counterweights", examples=[{"force": {"peak_N": 9994.7}}])
    after: FirstOrder | None = Field(
        description="with the counterweights; null where there are none to show (infeasible)",
        examples=[{"force": {"peak_N": 4997.4}}],
    )
    orders: ResidualOrders = Field(description="orders 1 and 2 as phasors", examples=[{"before": [{"order": 1}, None]}])
    responses: tuple[ResponseChange, ...] = Field(
        (), description="responses that are weighed or limited beside force and moment", examples=[[]]
    )
    turn: TurnResidual | None = Field(
        None,
        description="peaks of all orders; null where the objective looks at the first alone",
        examples=[{"before": {"force_peak_N": 13010.2}}],
    )


class Floor(Model):
    """What remains however large the counterweights: the counter-rotating phasors, as far as no shaft turns so."""

    force_N: Newtons = Field(description="smallest peak force that counterweights could reach", examples=[2498.7])
    moment_Nm: NewtonMetres = Field(
        description="smallest peak moment that counterweights could reach", examples=[9747.0]
    )
