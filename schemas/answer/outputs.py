"""All outputs: their fields in an answer, their names in a request, their columns in a sweep."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

from pydantic import AfterValidator, Field

from schemas.answer.dynamics import (
    Flywheel,
    Gas,
    Kinematics,
    MainBearings,
    Overturning,
    PistonForce,
    RodLoads,
    Torque,
)
from schemas.answer.foundation import OrderOfFoundation
from schemas.answer.loads import Loads
from schemas.answer.roll import Roll
from schemas.answer.stages import Acting, StageIron
from schemas.base.curves import Curve
from schemas.base.model import Model
from schemas.base.quantities import Degrees, NewtonMetres, Newtons
from schemas.scroll.pin_loads import PinLoads


class Hodograph(Model):
    """First-order force and moment over one turn of the shaft."""

    force_x_N: Curve[Newtons] = Field(description="x component of the force", examples=[[9994.7]])
    force_y_N: Curve[Newtons] = Field(description="y component of the force", examples=[[0.0]])
    moment_x_Nm: Curve[NewtonMetres] = Field(description="horizontal couple, of the x forces", examples=[[38989.0]])
    moment_y_Nm: Curve[NewtonMetres] = Field(description="vertical couple, of the y forces", examples=[[0.0]])


class Hodographs(Model):
    """Hodographs without and with counterweights, over shaft angles with the end point not repeated."""

    angle_deg: Curve[Degrees] = Field(description="shaft angles", examples=[[0.0, 1.0]])
    before: Hodograph = Field(description="without counterweights", examples=[{"force_x_N": [9994.7]}])
    after: Hodograph | None = Field(
        description="with the counterweights; null if infeasible", examples=[{"force_x_N": [4997.4]}]
    )


class ForcePhasor(Model):
    """A rotating force; real and imaginary part are its x and y components at shaft angle 0."""

    real_N: Newtons = Field(description="real part", examples=[2498.7])
    imag_N: Newtons = Field(description="imaginary part", examples=[0.0])
    magnitude_N: Newtons = Field(description="magnitude", examples=[2498.7])
    phase_deg: Degrees = Field(description="phase, -180 to 180; 0 where the magnitude is 0", examples=[0.0])


class MomentPhasor(Model):
    """A rotating couple; real and imaginary part are its x and y components at shaft angle 0."""

    real_Nm: NewtonMetres = Field(description="real part", examples=[9747.0])
    imag_Nm: NewtonMetres = Field(description="imaginary part", examples=[0.0])
    magnitude_Nm: NewtonMetres = Field(description="magnitude", examples=[9747.0])
    phase_deg: Degrees = Field(description="phase, -180 to 180; 0 where the magnitude is 0", examples=[0.0])


class ForceOrder(Model):
    """Force of one order: F = co e^{j s k theta} + counter e^{-j s k theta}."""

    co_rotating: ForcePhasor = Field(description="phasor that turns with the shaft", examples=[{"real_N": 2498.7}])
    counter_rotating: ForcePhasor = Field(
        description="phasor that turns against the shaft", examples=[{"real_N": 2498.7}]
    )
    peak_N: Newtons = Field(description="largest force of this order over a revolution", examples=[4997.4])


class MomentOrder(Model):
    """Moment of one order, the couple in the plane of the forces."""

    co_rotating: MomentPhasor = Field(description="phasor that turns with the shaft", examples=[{"real_Nm": 9747.0}])
    counter_rotating: MomentPhasor = Field(
        description="phasor that turns against the shaft", examples=[{"real_Nm": 9747.0}]
    )
    peak_Nm: NewtonMetres = Field(description="largest moment of this order over a revolution", examples=[19494.0])


class Order(Model):
    """Force and moment at one multiple of the shaft speed."""

    order: int = Field(description="multiple of the shaft speed", examples=[2])
    force: ForceOrder = Field(description="force on the frame", examples=[{"peak_N": 1998.9}])
    moment: MomentOrder = Field(description="moment about the reference plane", examples=[{"peak_Nm": 7797.8}])


class OrdersComparison(Model):
    """Orders 1, 2, 4 and 6 without and with counterweights."""

    before: tuple[Order, ...] = Field(description="without counterweights", examples=[[{"order": 1}]])
    after: tuple[Order, ...] | None = Field(
        description="with the counterweights; null if infeasible", examples=[[{"order": 1}]]
    )


class RuleOfThumb(Model):
    """A classic partial balance beside the optimum, for comparison."""

    name: str = Field(description="which rule", examples=["transfer 20 % of the first-order force"])
    source: str = Field(
        description="where the rule is from",
        examples=["lecture slides on balancing (Уравновешивание), single row, vertical"],
    )
    transferred_share: float = Field(description="share k of the force or moment turned across", examples=[0.25])
    total_mass_radius_kg_m: float = Field(
        description="total mass times radius that the rule asks for",
        examples=[2.8],
        json_schema_extra={"x-unit": "kg m"},
    )
    peak: float = Field(description="peak that it leaves, in the unit of the stage", examples=[7496.0])
    peak_along: float = Field(description="peak along the direction of the unbalance", examples=[7496.0])
    peak_across: float = Field(description="peak across it", examples=[2498.7])


class Stage(Model):
    """One of the eight stages in which an engineer balances a machine."""

    stage: Literal["I", "II", "III", "IV", "V", "VI", "VII", "VIII"] = Field(
        description="number of the stage", examples=["III"]
    )
    title: str = Field(description="what the stage is about", examples=["first-order forces of reciprocating masses"])
    quantity: str = Field(description="what the value is", examples=["peak force"])
    formula: str = Field(description="formula of the value", examples=["|A1| + |B1|"])
    value: float = Field(description="value without counterweights", examples=[9994.7])
    unit: str = Field(description="unit of value and remaining", examples=["N"])
    plane: str = Field(description="direction or plane in which it acts", examples=["along 0.0 deg"])
    frequency: str = Field(
        description="frequency in multiples of the shaft speed n and in Hz", examples=["n (8.33 Hz)"]
    )
    balanceable: Literal["fully", "partly", "no"] = Field(
        description="whether counterweights on the shaft can balance it", examples=["partly"]
    )
    remaining: float | None = Field(
        description="what counterweights and balance shafts leave; null if infeasible", examples=[4997.4]
    )
    acting: tuple[Acting, ...] = Field(
        (), description="what the stage is about, without counterweights, as data", examples=[[{"order": 1}]]
    )
    left: tuple[Acting, ...] | None = Field(
        None,
        description="what they leave of it, in stage VIII of all; null if infeasible",
        examples=[[{"order": 1}]],
    )
    iron: tuple[StageIron, ...] = Field(
        (), description="stage VII: mass times radius by plane, for any share", examples=[[]]
    )
    rules_of_thumb: tuple[RuleOfThumb, ...] = Field(
        (), description="classic partial balances for comparison", examples=[[]]
    )


Stages = tuple[Stage, ...]


class InternalMoment(Model):
    """Largest first-order moment inside the shaft: the couple of all forces on one side of a plane about it."""

    before_Nm: NewtonMetres = Field(description="without counterweights, largest over shaft and turn", examples=[812.0])
    after_Nm: NewtonMetres | None = Field(description="with counterweights; null if infeasible", examples=[203.0])


class OutputFields(Model):
    """What a scene may ask for beyond the residual; null where it was not asked for."""

    hodograph: Hodographs | None = Field(
        None, description="first order over a revolution, if asked for", examples=[None]
    )
    orders: OrdersComparison | None = Field(None, description="phasors by order, if asked for", examples=[None])
    foundation_loads: tuple[OrderOfFoundation, ...] | None = Field(
        None, description="loads on the foundation by order, if asked for", examples=[None]
    )
    stages: Stages | None = Field(None, description="the eight balancing stages, if asked for", examples=[None])
    internal_moment: InternalMoment | None = Field(
        None, description="moment inside the shaft, if asked for", examples=[None]
    )
    kinematics: Kinematics | None = Field(None, description="motion of every row, if asked for", examples=[None])
    gas: Gas | None = Field(None, description="gas forces, if asked for", examples=[None])
    piston_force: PistonForce | None = Field(None, description="piston forces, if asked for", examples=[None])
    rod_loads: RodLoads | None = Field(None, description="forces in the mechanism, if asked for", examples=[None])
    torque: Torque | None = Field(None, description="torque, if asked for", examples=[None])
    flywheel: Flywheel | None = Field(None, description="flywheel, if asked for", examples=[None])
    overturning: Overturning | None = Field(None, description="overturning couple, if asked for", examples=[None])
    roll: Roll | None = Field(None, description="roll moment, if asked for or weighed", examples=[None])
    loads: Loads | None = Field(None, description="loads of parts, guides and base, if asked for", examples=[None])
    main_bearings: MainBearings | None = Field(None, description="bearing loads, if asked for", examples=[None])
    pin_loads: PinLoads | None = Field(None, description="scroll pin loads, if asked for", examples=[None])


if TYPE_CHECKING:
    OutputName = str
else:
    #: the residual and the balance rate, which every optimisation answers, and the fields above
    OutputName = Literal["residual", "balance_rate", *OutputFields.model_fields]
#: none is the residual, as where nothing is said
OutputNames = Annotated[
    tuple[OutputName, ...], Field(max_length=32), AfterValidator(lambda names: names or ("residual",))
]

Kind = Literal["integer", "number", "text"]


class Column(NamedTuple):
    """One column of the result."""

    name: str
    kind: Kind
    unit: str | None
    meaning: str
    source: str | None = None  # JSON pointer in the base, of axes and webs


#: orders and stages that are columns, and the units of these
_ORDERS = (1, 2, 4, 6)
STAGE_UNITS = {"I": "N", "II": "N m", "III": "N", "IV": "N m", "V": "N", "VI": "N m", "VII": "kg m", "VIII": "N"}


def _order_columns(order: int) -> Iterator[Column]:
    """Peaks and phasors of one order: F = co e^{j s k theta} + counter e^{-j s k theta}, as drawn at shaft angle 0."""
    for quantity, short, unit in (("force", "N", "N"), ("moment", "Nm", "N m")):
        of = f"{quantity} of order {order} with the counterweights"
        yield Column(f"{quantity}_peak_{short}.order_{order}", "number", unit, f"peak {of}")
        for sense in ("co", "counter"):
            for part, axis in (("real", "x"), ("imag", "y")):
                name = f"{quantity}_{sense}_rotating_{part}_{short}.order_{order}"
                yield Column(name, "number", unit, f"{axis} of the {sense}-rotating phasor of the {of}")


def _stage_columns(stage: str, unit: str) -> Iterator[Column]:
    yield Column(f"stage_value.{stage}", "number", unit, f"value of balancing stage {stage}, without counterweights")
    yield Column(f"stage_remaining.{stage}", "number", unit, f"what the counterweights leave of stage {stage}")


#: what each comes to in a sweep; a sweep refuses an output that is not here
OUTPUT_COLUMNS: dict[str, tuple[Column, ...]] = {
    "residual": (),
    "balance_rate": (),
    "orders": tuple(column for order in _ORDERS for column in _order_columns(order)),
    "stages": tuple(column for stage, unit in STAGE_UNITS.items() for column in _stage_columns(stage, unit)),
    "internal_moment": (
        Column(
            "internal_moment_Nm",
            "number",
            "N m",
            "largest first-order moment inside the shaft",
        ),
    ),
    "gas": (Column("indicated_power_W", "number", "W", "power put into the gas"),),
    "piston_force": (
        Column("peak_piston_force_N", "number", "N", "largest piston force over a revolution, magnitude"),
    ),
    "rod_loads": (Column("peak_rod_load_N", "number", "N", "largest rod force of all load cases, magnitude"),),
    "torque": (
        Column("mean_torque_Nm", "number", "N m", "mean torque over a revolution, whatever the samples"),
        Column("peak_torque_Nm", "number", "N m", "largest torque over a revolution, magnitude"),
        Column("fluctuation_energy_J", "number", "J", "energy that a flywheel takes up and gives back"),
        Column("shaft_power_W", "number", "W", "mean torque times angular speed"),
        Column("indicated_power_W", "number", "W", "power put into the gas"),
        Column("friction_power_W", "number", "W", "power lost to friction"),
    ),
    "flywheel": (
        Column("irregularity", "number", None, "range of the speed over its mean"),
        Column("inertia_J_kg_m2", "number", "kg m2", "polar moment of inertia of all that turns"),
    ),
    "overturning": (
        Column("peak_overturning_Nm", "number", "N m", "largest overturning couple over a revolution, magnitude"),
    ),
    "roll": (
        Column("peak_roll_Nm", "number", "N m", "largest roll moment over a revolution without its mean, magnitude"),
    ),
    "loads": (
        Column(
            "peak_crosshead_pin_N", "number", "N", "largest rod force of a running row over a revolution, magnitude"
        ),
        Column("peak_sudden_stop_N", "number", "N", "largest rod force of gas alone over a revolution, magnitude"),
        Column("own_base_peak_Nm", "number", "N m", "largest torque on a base of the machine's own, magnitude"),
        Column("shared_base_peak_Nm", "number", "N m", "largest torque on a base shared with the driver, magnitude"),
    ),
    "main_bearings": (
        Column("peak_bearing_load_N", "number", "N", "largest load of all main bearings, with the counterweights"),
        Column("peak_bending_Nm", "number", "N m", "largest bending moment inside the shaft, with the counterweights"),
    ),
    "pin_loads": (Column("peak_pin_load_N", "number", "N", "largest load of all anti-rotation pins"),),
}


class PartColumns(NamedTuple):
    """Columns that an output has for each of some parts of the machine; the name of the part follows after a dot."""

    parts: Literal["throws", "bearings"]
    columns: tuple[Column, ...]


#: what some come to besides, part by part
COLUMNS_OF_PARTS: dict[str, PartColumns] = {
    "balance_rate": PartColumns(
        "throws",
        (
            Column("balance_rate", "number", None, "share of the rotating unbalance of this throw that is balanced"),
            Column("balance_rate_sideways", "number", None, "what its counterweights do across the crank, as a share"),
        ),
    ),
    "loads": PartColumns("bearings", (Column("bearing_weight_N", "number", "N", "weight on this bearing"),)),
    "main_bearings": PartColumns(
        "bearings", (Column("bearing_peak_N", "number", "N", "largest load of this bearing, with the counterweights"),)
    ),
}


def labels(names: Sequence[str | None]) -> tuple[str, ...]:
    """What parts of a machine are called in names of columns: their names if all have one, else 0, 1, 2, ..."""
    texts = [name for name in names if name is not None]
    return tuple(texts) if len(texts) == len(names) else tuple(str(number) for number in range(len(names)))
