"""The trade-off between peak force and peak moment: request and answer."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from schemas.answer.answers import EffectUses, Timing
from schemas.answer.caution import StatusReason
from schemas.answer.counterweights import ShaftsMass, ShaftUnbalances, WebCounterweights
from schemas.answer.first_order import FirstOrder, Floor
from schemas.answer.infeasibility import InfeasibilityProof
from schemas.answer.limits import MachineLimit
from schemas.answer.proof import EndMultipliers, Multipliers
from schemas.answer.robust import WorstPeaks
from schemas.base.model import Answer, Displayable, Model, NotEmpty
from schemas.base.quantities import Count, Flag, Kilograms, Mass, Metres, Name, NewtonMetres, Newtons
from schemas.base.rules import Rule, first_of
from schemas.base.units import Unit, between
from schemas.front.counts import CountFront, CountTrade
from schemas.front.trade import MAX_TRADED_POINTS, TradedFront, TradedNames
from schemas.machine.reciprocating import balance_shafts
from schemas.request.requests import OptimizeRequest
from schemas.request.scenarios import Tolerances

MAX_POINTS = 201
MAX_BUDGETS = 10
#: points of all fronts of one request
MAX_POINTS_TOGETHER = 600
#: the same times the webs: what bounds the work
MAX_PLACES = 20_000

Status = Literal["optimal", "inaccurate", "infeasible"]
_NO_ORDER = "a front has no order of its goals"

Reason = Literal["reached_together", "resolution", "undecided", "complete", "time"]
Budgets = Annotated[tuple[Annotated[Mass, Unit("kg")], ...], Field(max_length=MAX_BUDGETS), NotEmpty()]


class ParetoRequest(OptimizeRequest):
    """The force-moment front of a machine, and its change with the total mass.

    Of the objective, direction weights, ceilings and ``least_mass`` count, and where responses are named what says how
    they are measured; how they are weighed and combined does not. Of the outputs, the residual alone is computed.
    """

    points: Annotated[Count, between(2, MAX_POINTS)] = Field(
        21, description="number of points of each front, its ends included", examples=[21]
    )
    total_mass_budgets_kg: Budgets | None = Field(
        None,
        description="a front for each of these limits of the total mass, in place of the machine's own"
        " max_total_mass_kg; null is one front with the machine's own",
        examples=[[120.0, 180.0, 240.0]],
    )

    responses: TradedNames | None = Field(
        None,
        description="any two or three to trade for one another, in `trades` of the answer; null is force against moment"
        " of the first order, in `fronts`",
        examples=[["bearings", "mass"]],
    )

    counts: CountTrade | None = Field(
        None,
        description="the number of counterweights, or of part numbers, against the least objective or mass that so few"
        " come to, in `counts` of the answer; for counterweights that are chosen from a catalogue",
        examples=[{"of": "weights", "least": "objective"}],
    )

    multipliers: Flag = Field(
        False, description="the multipliers of every point's certificate, and of the ends'", examples=[False]
    )

    @property
    def is_nonconvex(self) -> bool:
        """Whether counterweights have options, minimum masses, or plates."""
        machine = self.machine
        return machine.choice is not None or any(web.envelope is not None for web in machine.every_web)

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        yield from self.allowance_rules("remove it: counts, or the mass among the responses, trade what choices cost")
        yield from self._trade_rules()
        if self.tolerances is not None and self.machine.choice == "semicontinuous":
            yield from self._scatter_rules(self.tolerances)
        if self.counts is not None:
            yield from self.envelope_rules("counts are of a catalogue, whose counterweights have a known radius")
            yield from self._count_rules(self.counts)
        elif self.is_nonconvex:
            message = "remove it: it proves what free masses at free angles reach, and these counterweights are chosen"
            yield Rule(self.multipliers, ("multipliers",), message)
        budgets, shafts = self.total_mass_budgets_kg or (), balance_shafts(self.machine)
        message = "with balance shafts the total mass has no limit: limit the masses of the webs"
        yield Rule(bool(budgets and shafts), ("total_mass_budgets_kg",), message)
        fixed = sum((web.fixed.mass_kg for web in self.machine.webs if web.fixed is not None), 0.0)
        for index, budget in enumerate(budgets):
            path = ("total_mass_budgets_kg", index)
            yield Rule(budget in budgets[:index], path, "this budget is in the list already")
            yield Rule(budget < fixed, path, "the fixed counterweights are heavier than this budget")
        webs = sum((len(shaft.webs) for shaft in shafts), len(self.machine.webs))
        together, places = self.points * len(budgets), self.points * max(1, len(budgets)) * webs
        points = f"points times budgets must be at most {MAX_POINTS_TOGETHER}"
        work = f"points times budgets times webs must be at most {MAX_PLACES}"
        yield from first_of(
            [Rule(together > MAX_POINTS_TOGETHER, ("points",), points), Rule(places > MAX_PLACES, ("points",), work)]
        )

    def _count_rules(self, counts: CountTrade) -> Iterator[Rule]:
        message = "counts need a catalogue: give `catalogue`, or masses and hole angles of every web"
        yield Rule(not self.machine.discrete, ("counts",), message)
        yield Rule(self.responses is not None, ("responses",), "give either responses or counts")
        yield Rule(self.multipliers, ("multipliers",), "remove it: only the front of force and moment takes it")
        ceilings = [name for name in type(self.objective).model_fields if "_ceiling_" in name]
        limited = any(getattr(self.objective, name) is not None for name in ceilings)
        message = "without a ceiling the minimum mass is 0: give at least one ceiling"
        yield Rule(counts.least == "mass" and not limited, ("counts", "least"), message)
        has_order = bool(self.objective.priorities) and self.responses is None
        yield Rule(has_order, ("objective", "priorities"), _NO_ORDER)

    def _scatter_rules(self, tolerances: Tolerances) -> Iterator[Rule]:
        """What scatters with a choice is a term for each web of a response of the first order."""
        over_turn = [name for name in self.responses or () if name in ("bearings", "bending", "roll")]
        for name in ("mass_relative", "angle_deg") if over_turn else ():
            message = (
                f"not with choices and the response {over_turn[0]}: choose without, then ask with the choice fixed"
            )
            yield Rule(getattr(tolerances, name) > 0, ("tolerances", name), message)

    def _trade_rules(self) -> Iterator[Rule]:
        if self.responses is None:
            for name in self.objective.over_the_turn if self.counts is None else ():
                message = "this front is of first-order peaks: name the goals in `responses` instead"
                yield Rule(True, ("objective", name), message)
            return
        yield Rule(bool(self.objective.priorities), ("objective", "priorities"), _NO_ORDER)
        if "objective" in self.responses:
            yield from self._objective_rules(self.responses)
        for index, name in enumerate(self.responses):
            yield Rule(name in self.responses[:index], ("responses", index), "this response is in the list already")
            message = "balance shafts alone change the roll moment, and the machine has none"
            yield Rule(name == "roll" and not balance_shafts(self.machine), ("responses", index), message)
        yield Rule(self.multipliers, ("multipliers",), "remove it: only the front of force and moment takes it")
        together = self.points * max(1, len(self.total_mass_budgets_kg or ()))
        most = f"points times budgets must be at most {MAX_TRADED_POINTS} where responses are named"
        yield Rule(together > MAX_TRADED_POINTS, ("points",), most)

    def _objective_rules(self, names: TradedNames) -> Iterator[Rule]:
        """The objective is made of what else could be traded, and stands beside the mass alone."""
        message = "name `objective` and `mass` alone: the objective is made of the other responses"
        yield Rule(set(names) != {"objective", "mass"}, ("responses",), message)
        goal = self.objective
        for name in ("bearing_weight", "bending_weight", "roll_weight"):
            message = "remove it: the objective that is traded weighs force and moment of the first order"
            yield Rule(getattr(goal, name) != 0, ("objective", name), message)
        message = 'give "first": the objective that is traded is of the first order'
        yield Rule(goal.orders != "first", ("objective", "orders"), message)


class Scale(Model):
    """What gaps are relative to: the weighted peaks without counterweights.

    Where there is no such peak, what the counterweights at the other end do one by one.
    """

    force_N: Newtons = Field(description="of forces", examples=[10006.1])
    moment_Nm: NewtonMetres = Field(description="of moments", examples=[48734.5])


class CornerCertificate(Model):
    """The proof of a point: no counterweights within the limits are below this corner in both peaks."""

    force_N: Newtons | None = Field(
        description="no counterweights have a weighted peak force up to this and a smaller weighted peak moment than"
        " moment_Nm; null if nothing is proven",
        examples=[7504.59],
    )
    moment_Nm: NewtonMetres | None = Field(
        description="no counterweights have a weighted peak moment up to this and a smaller weighted peak force than"
        " force_N; null if nothing is proven",
        examples=[20123.27],
    )
    relative_gap: float | None = Field(
        description="how far the point is above the corner: the larger of both differences, each relative to its"
        " `yardstick`; null if nothing is proven",
        examples=[8e-13],
    )
    yardstick: Scale = Field(
        description="what the relative gap is relative to: the front's scale", examples=[{"force_N": 10006.1}]
    )
    mass_lower_bound_kg: Kilograms | None = Field(
        description="no counterweights that are as good in both peaks, to within that gap, have a smaller total mass;"
        " null if minimum mass was not asked for",
        examples=[236.35],
    )
    mass_relative_gap: float | None = Field(
        description="total mass above that bound, over `yardstick`; null likewise", examples=[3e-8]
    )
    mass_yardstick_kg: Kilograms | None = Field(
        description="what the mass gap is relative to: the total mass. Where that is less, it is 1e-5 of the minimum"
        " mass that could cancel one of the peaks, or a response under a ceiling, at the web where a kilogram does"
        " most. The gap allowed then changes none by more than the tolerance of a ceiling. Null if minimum mass was"
        " not asked for",
        examples=[236.35],
    )
    mass_force_limit_N: Newtons | None = Field(
        description="largest weighted peak force that the bound of the mass allows; null if minimum mass was not asked"
        " for",
        examples=[7504.6],
    )
    mass_moment_limit_Nm: NewtonMetres | None = Field(
        description="largest weighted peak moment that the bound of the mass allows; null likewise",
        examples=[20123.28],
    )
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        description="largest masses that the bounds count with, of webs without a limit or with one beyond any need:"
        " those of the front, as a bound at one point speaks of all others",
        examples=[{"1a": 412.5}],
    )
    method: str = Field(description="what found the counterweights", examples=["cone program, clarabel"])


class ParetoPoint(Model):
    """Counterweights that no others beat in both peaks."""

    status: Literal["optimal", "inaccurate"] = Field(
        description="optimal: certified to the asked gap; inaccurate: certified to a larger gap, which is reported",
        examples=["optimal"],
    )
    status_reason: StatusReason
    force_peak_N: Newtons = Field(
        description="first-order peak force of the unchanged machine, nothing off", examples=[7504.6]
    )
    moment_peak_Nm: NewtonMetres = Field(description="first-order peak moment, likewise", examples=[20123.28])
    weighted_force_peak_N: Newtons = Field(
        description="peak of the force with direction weights in the worst case, which is traded, times the weight of"
        " its scenario. It is the peak force where all are 1 and nothing is off",
        examples=[7504.6],
    )
    weighted_moment_peak_Nm: NewtonMetres = Field(
        description="peak of the moment with direction weights in the worst case, which is traded, times the weight of"
        " its scenario. It is the peak moment where all are 1 and nothing is off",
        examples=[20123.28],
    )
    worst_case: WorstPeaks | None = Field(
        None,
        description="both peaks in the worst case, without weights of directions and scenarios; null without scenarios"
        " and tolerances",
        examples=[None],
    )
    total_mass_kg: Kilograms = Field(
        description="total mass of the counterweights on the crankshaft", examples=[236.35]
    )
    counterweights: WebCounterweights
    balance_shafts: ShaftUnbalances = ()
    balance_shafts_mass_kg: ShaftsMass = None
    active_limits: tuple[MachineLimit, ...] = Field(
        description="limits of the whole machine that the point touches", examples=[["max_total_mass"]]
    )
    certificate: CornerCertificate = Field(description="the proof", examples=[{"relative_gap": 8e-13}])
    multipliers: Multipliers | None = Field(
        None,
        description="the multipliers of corner and mass, if asked for; the rows are the weighted peaks, in 1/N and"
        " 1/(N m), or kg/N and kg/(N m)",
        examples=[None],
    )


class Ends(Model):
    """Where each weighted peak is smallest and, among all such, the other is smallest."""

    smallest_force_N: Newtons = Field(description="weighted peak force at the first point", examples=[5003.07])
    smallest_force_lower_bound_N: Newtons = Field(
        description="certified: no counterweights within the limits have a smaller one", examples=[5003.06]
    )
    moment_at_smallest_force_Nm: NewtonMetres = Field(
        description="weighted peak moment at the first point", examples=[20298.4]
    )
    smallest_moment_Nm: NewtonMetres = Field(description="weighted peak moment at the last point", examples=[19948.2])
    smallest_moment_lower_bound_Nm: NewtonMetres = Field(
        description="certified: no counterweights within the limits have a smaller one", examples=[19948.1]
    )
    force_at_smallest_moment_N: Newtons = Field(description="weighted peak force at the last point", examples=[10006.1])
    multipliers: EndMultipliers | None = Field(
        None, description="the multipliers of both bounds, if asked for", examples=[None]
    )


class ParetoFront(Displayable):
    """The front under one limit of the total mass."""

    max_total_mass_kg: Kilograms | None = Field(
        description="limit of the total mass of this front; null is none", examples=[None]
    )
    status: Status = Field(
        description="optimal: every point is; inaccurate: a point is not; infeasible: no counterweights satisfy the"
        " ceilings",
        examples=["optimal"],
    )
    points: tuple[ParetoPoint, ...] = Field(
        description="in the order of rising force and falling moment; none if infeasible", examples=[[]]
    )
    reason: Reason | None = Field(
        None,
        description="why there are fewer points than asked for. reached_together: both peaks are smallest at the same"
        " counterweights, within the asked gap. resolution: points that rounding could not separate were left out."
        " undecided: the ceilings are on the very boundary of what can be reached, and the point comes closest."
        " Where counterweights are chosen: complete: no set is better than these by more than the asked gap; time:"
        " accuracy.time_limit_s ended the search",
        examples=[None],
    )
    knee: int | None = Field(
        None,
        description="index of the point farthest from the straight line between the ends, in the plane of shares of the"
        " range; null where the front is a point or straight",
        examples=[10],
    )
    ends: Ends | None = Field(None, description="the ends; null if infeasible", examples=[None])
    scale: Scale | None = Field(None, description="what gaps are relative to; null if infeasible", examples=[None])
    implied_max_mass_kg: dict[Name, Kilograms] = Field(
        default_factory=dict,
        description="largest masses that every bound of the front counts with, of webs without a limit or with one"
        " beyond any need: it is proven that whatever the front is made of, and the lightest, lies within them",
        examples=[{"1a": 412.5}],
    )
    infeasibility: InfeasibilityProof = None


class ParetoAnswer(Answer):
    """The certified trade-off of force, moment and mass."""

    status: Status = Field(description="the worst of the fronts", examples=["optimal"])
    fronts: tuple[ParetoFront, ...] = Field(
        description="one for each budget of the total mass, in the order asked; without budgets one. None where"
        " responses are named",
        examples=[[]],
    )
    trades: tuple[TradedFront, ...] = Field(
        (), description="the same of the responses that are named; none without", examples=[[]]
    )
    counts: tuple[CountFront, ...] = Field(
        (), description="the same of the number of counterweights or of part numbers; none without", examples=[[]]
    )
    without_counterweights: FirstOrder = Field(
        description="first order without counterweights", examples=[{"force": {"peak_N": 10006.1}}]
    )
    floor: Floor = Field(description="what no counterweights can remove", examples=[{"force_N": 5003.1}])
    reference_plane_m: Metres = Field(description="plane of the moments", examples=[0.0])
    effects: EffectUses
    timing: Timing = Field(description="where the time went", examples=[{"total_ms": 210.0}])
