"""What accuracy costs in time on a machine: the request, and the ladders of methods that answer it."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from schemas.base.model import Answer, Model
from schemas.base.quantities import Count, Kilograms, Milliseconds
from schemas.base.rules import Rule
from schemas.request.requests import OptimizeRequest

GoalName = Literal["external", "bearings", "bending"]


class AccuracyRequest(OptimizeRequest):
    """Measure what accuracy costs on a machine. `outputs` and `angles` play no part.

    Nor does `accuracy`, but for the time limit where counterweights are chosen.
    """

    repeats: Annotated[Count, Field(ge=1, le=20)] = Field(
        5, description="rounds of timing; every method runs once in a round", examples=[5]
    )

    @property
    def has_production_limits(self) -> bool:
        """Whether counterweights are as a workshop makes them: options, minimum masses, equal castings, or plates."""
        machine = self.machine
        cut = any(web.envelope is not None for web in machine.every_web)
        return machine.choice is not None or bool(machine.web_groups) or cut

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        yield from self.allowance_rules("the ladder has a row for every way to one choice, and none for cheaper ones")
        several = self.has_production_limits and bool(self.objective.priorities)
        message = "the ladder of production limits is of one goal: remove the order of several"
        yield Rule(several, ("objective", "priorities"), message)


class GoalError(Model):
    """How far counterweights are off in a goal before the last."""

    goal: GoalName = Field(description="the goal", examples=["external"])
    relative_error: float = Field(
        description="what it comes to, recomputed, minus its best certified lower bound, over what it is without"
        " counterweights; up to its allowance no fault",
        examples=[0.01],
    )


class AccuracyRow(Model):
    """One method with one setting, on the smallest objective (least mass is off)."""

    method: str = Field(
        description="service: what /v1/optimize does; interior_point: its compiled method alone, with its bound; "
        "interior_point_batch: the same on many programs at once, as a sweep does; interior_point_interpreted: the "
        "same in finer numbers; cone_program: the exact program, compiled once, one solve by clarabel; "
        "cone_program_matrices: the same without a modelling layer; sampled_angles: peaks seen only at sampled "
        "shaft angles; polygonal_cones: linear, polygons in place of circles. With tolerances or scenarios also "
        "nominal: the optimum with nothing off; partly_off: with counterweights, masses or scenarios alone; "
        "first_order: with masses at corners that are worst by derivatives at the nominal optimum; corners: at those "
        "that so many rounds know. With scenarios also one_scenario: the optimum of one by itself; worst_scenarios: of "
        "those that so many rounds know. Over a revolution also orders: responses without the orders above some, at "
        "360 angles; cuts: responses at the angles of the peaks of so many rounds",
        examples=["sampled_angles"],
    )
    setting: str = Field(description="what is varied within the method", examples=["36 angles"])
    time_ms: Milliseconds | None = Field(
        description="median over the rounds, from the program to counterweights within the limits, set-up excluded; "
        "of the service and of interior points with their bounds; null where there is no answer",
        examples=[2.1],
    )
    first_ms: Milliseconds | None = Field(
        description="time of the very first run, which compiles what is compiled once", examples=[14.0]
    )
    relative_error: float | None = Field(
        description="objective of the counterweights, recomputed, minus the best certified lower bound, over the "
        "objective without counterweights; the largest over the positions of the angle grid or polygon. Below 0 "
        "only where ceilings or limits of earlier goals are broken",
        examples=[1.2e-3],
    )
    as_drawn_error: float | None = Field(
        description="the same with the grid or polygon as it falls on the machine as drawn", examples=[4e-4]
    )
    certified_gap: float | None = Field(
        description="the same against the bound that the method proves by itself, from its own multipliers, the "
        "largest over the positions; null where it proves nothing",
        examples=[2e-3],
    )
    claim_error: float | None = Field(
        description="how far the objective that the method itself sees lies from that of its counterweights, over the"
        " objective without counterweights. Negative where it promises too much; null where it is not shown",
        examples=[-3.8e-3],
    )
    excess: float | None = Field(
        description="largest excess over a ceiling relative to its size, or over the limit of a goal before the last; "
        "above 1e-9 they are broken and the row is no candidate for the frontier; null where there are none",
        examples=[None],
    )
    goals: tuple[GoalError, ...] = Field(
        (), description="the goals before the last, in their order; empty where there is one goal", examples=[[]]
    )
    programs: int = Field(
        1, description="programs that one run solves at once: times are for one of them", examples=[1]
    )
    on_frontier: bool = Field(
        description="whether no other row is both as fast and as accurate, errors below the resolution being equal; "
        "rows of many programs at once are no candidates",
        examples=[True],
    )
    runs: int = Field(description="timed runs behind the median", examples=[5])
    skipped: str | None = Field(None, description="why there is no answer", examples=[None])


class ChoiceRow(Model):
    """One way to counterweights as a workshop makes them, and what comes of the time that it takes."""

    method: Literal["service", "rounding"] = Field(
        description="service: what /v1/optimize does, with the minimum mass where that is asked for; rounding: the "
        "optimum of any masses at any angles, of a group the mean, each on what is nearest of its web",
        examples=["service"],
    )
    setting: str = Field(description="the limit of time or the gap that is asked for", examples=["0.3 s"])
    status: str | None = Field(
        description="of the answer; null of a rounding, which proves nothing", examples=["optimal"]
    )
    time_ms: Milliseconds | None = Field(
        description="computing time, as limits of time count it: median over the rounds, of one run if that is long",
        examples=[310.0],
    )
    objective: float | None = Field(
        description="of the counterweights, recomputed; null where there are none", examples=[40881.9]
    )
    lower_bound: float | None = Field(
        description="that the row proves by itself; null where it proves none", examples=[40549.4]
    )
    relative_error: float | None = Field(
        description="objective minus the best bound of all rows, over the objective without counterweights",
        examples=[2e-4],
    )
    certified_gap: float | None = Field(
        description="objective minus the own bound, over the objective without counterweights", examples=[3e-4]
    )
    total_mass_kg: Kilograms | None = Field(
        description="of all counterweights, fixed ones and those on balance shafts included", examples=[91.5]
    )
    pieces: int | None = Field(
        description="counterweights that are not fixed, of any mass on balance shafts left out", examples=[3]
    )
    sizes: int | None = Field(description="different masses among them", examples=[2])
    limits_kept: bool = Field(
        description="whether ceilings, budget, number and part numbers are kept, which rounding may break",
        examples=[True],
    )
    on_frontier: bool = Field(
        description="whether no other row that keeps the limits is both as fast and as good", examples=[True]
    )
    runs: int = Field(description="timed runs behind the median", examples=[5])
    skipped: str | None = Field(None, description="why there is no answer", examples=[None])


class EffectRow(Model):
    """One way to simulate, and how far one figure of the turn is off."""

    quantity: Literal[
        "mean_torque", "peak_torque", "fluctuation_energy", "peak_inertia_torque", "inertia_fluctuation_energy"
    ] = Field(description="figure over the cycle", examples=["fluctuation_energy"])
    method: Literal["panels", "search", "samples"] = Field(
        description="panels: what the service does, Gauss-Legendre panels between the kinks; search: the peak on "
        "both sides of every jump and between them; samples: values at equal steps, the mean as their average, the "
        "energy by the trapezoidal rule",
        examples=["samples"],
    )
    setting: str = Field(description="kinematics, or step of the shaft angle", examples=["5 deg"])
    time_ms: Milliseconds = Field(description="median over the rounds", examples=[0.4])
    first_ms: Milliseconds = Field(description="time of the very first run", examples=[0.9])
    relative_error: float | None = Field(
        description="distance from the reference over the reference; of the reference itself its own estimate, null "
        "where it has none",
        examples=[2e-3],
    )
    runs: int = Field(description="timed runs behind the median", examples=[5])


class PeakRow(Model):
    """One peak over the turn by one way, without counterweights."""

    quantity: Literal["peak_bearing_load", "peak_bending_moment", "peak_torque"] = Field(
        description="largest load of all main bearings, largest bending moment along the shaft, largest torque",
        examples=["peak_bearing_load"],
    )
    method: Literal["bracket", "pieces", "samples"] = Field(
        description="bracket: proven on both sides, as the service answers; pieces: an uneven grid, samples in every "
        "piece between valves, dead centres and entries of tables, both sides of a jump among them; samples: equal "
        "steps",
        examples=["bracket"],
    )
    setting: str = Field(description="tolerance, samples in a piece, or step", examples=["1e-09"])
    angles: int | None = Field(description="angles that are looked at; null of a bracket", examples=[360])
    time_ms: Milliseconds = Field(description="median over the rounds", examples=[3.1])
    first_ms: Milliseconds = Field(description="time of the very first run", examples=[3.9])
    relative_error: float = Field(
        description="by how much the peak that was found is below the sharpest bracket's, over that", examples=[1e-4]
    )
    certified_gap: float | None = Field(
        description="upper end of the bracket less its lower one, over that; null where nothing is proven",
        examples=[1e-9],
    )
    runs: int = Field(description="timed runs behind the median", examples=[5])


class GoalBefore(Model):
    """A goal before the last, whose limit all methods are given."""

    goal: GoalName = Field(description="the goal", examples=["external"])
    value: float = Field(description="smallest found, under the limits of the goals before it", examples=[30345.0])
    lower_bound: float = Field(description="certified: under these limits nothing is smaller", examples=[30344.97])
    limit: float = Field(description="what the goals after it have to keep", examples=[30405.7])
    without_counterweights: float = Field(description="what its errors are relative to", examples=[58740.5])


class Reference(Model):
    """What errors are measured from; with tolerances or scenarios all of it is of the worst case.

    Of several goals the objective is the last.
    """

    objective: float = Field(description="smallest objective found", examples=[41250.2])
    lower_bound: float = Field(
        description="best certified lower bound: no counterweights within the limits have a smaller objective",
        examples=[41250.2],
    )
    objective_without_counterweights: float = Field(description="what errors are relative to", examples=[97032.0])
    objective_of_any_mass: float | None = Field(
        None,
        description="the optimum of any masses at any angles, which counterweights as a workshop makes them cannot"
        " reach; null where they are any",
        examples=[None],
    )
    goals: tuple[GoalBefore, ...] = Field(
        (), description="the goals before the last, in their order; empty where there is one goal", examples=[[]]
    )
    resolution: float = Field(
        description="smallest objective found minus bound, relative, and at least the rounding of objectives: errors "
        "are not known more closely",
        examples=[1e-13],
    )


class ProgramSize(Model):
    """Size of the program behind the ladder."""

    webs: int = Field(description="webs that can carry a counterweight", examples=[4])
    norm_terms: int = Field(
        description="norms in the objective; over a revolution responses, each with one at every angle", examples=[2]
    )
    ceilings: int = Field(description="ceilings on peaks", examples=[0])
    sectors: int = Field(description="webs with a sector", examples=[0])
    mass_budget: bool = Field(description="whether the total mass is limited", examples=[False])
    rows: int = Field(description="rows of the machine", examples=[2])


class Environment(Model):
    """What the times were measured with."""

    versions: dict[str, str] = Field(
        description="versions of the language and of the packages; HiGHS is the one within scipy",
        examples=[{"clarabel": "0.11.1"}],
    )
    cpus: int = Field(description="processors of the machine; every solve runs on one", examples=[2])


Status = Literal["measured", "nothing_to_choose", "infeasible", "contradicted"]


class AccuracyAnswer(Answer):
    """The ladders."""

    status: Status = Field(
        description="nothing_to_choose: no web can carry anything, or the objective is 0 without counterweights, and "
        "the ladder is empty; infeasible: no counterweights satisfy the ceilings, and the ladder is empty; "
        "contradicted: a bound is above a value that was found, a fault of the service; nothing is measured from it",
        examples=["measured"],
    )
    reference: Reference | None = Field(
        description="what errors are measured from; null if infeasible or contradicted",
        examples=[{"objective": 41250.2}],
    )
    size: ProgramSize = Field(description="size of the program", examples=[{"webs": 4}])
    repeats: int = Field(description="rounds of timing", examples=[5])
    positions: int = Field(description="positions of angle grids and polygons that were tried", examples=[4])
    ladder: tuple[AccuracyRow, ...] = Field(description="methods and settings", examples=[[]])
    choices_ladder: tuple[ChoiceRow, ...] = Field(
        (),
        description="counterweights as a workshop makes them: gap, mass and pieces against time. Then `ladder` is "
        "empty, and this is without groups, choices, minimum fitted masses and plates",
        examples=[[]],
    )
    effects_ladder: tuple[EffectRow, ...] = Field(
        description="simulated effects: cut-off kinematics against exact, samples against panels; empty where the "
        "machine gives no rods. With cylinders the torque of gas, inertia and friction, otherwise of inertia",
        examples=[[]],
    )
    peaks_ladder: tuple[PeakRow, ...] = Field(
        description="peaks over the cycle, brute force on even and uneven grids against the bracket; empty where the "
        "machine gives no rods, and of bearings and bending only where it has bearings",
        examples=[[]],
    )
    environment: Environment = Field(description="what the times were measured with", examples=[{"cpus": 2}])
    total_ms: Milliseconds = Field(description="whole computation after validation", examples=[900.0])
