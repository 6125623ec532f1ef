"""Warnings of an answer: what is right as it stands and may still be taken for something else."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from operator import mul
from typing import Any

import numpy as np

from optimizer.formulation.formulate import span
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.cylinders import without_gas
from optimizer.numerics.arrays import Complex
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.outputs.balance_rate import cranks
from optimizer.outputs.brackets import brackets, has_brackets, numbers
from optimizer.outputs.peaks import customary_peaks
from schemas.answer.answers import BalanceRate, Certificate
from schemas.answer.caution import Caution, CautionCode
from schemas.answer.dynamics import MainBearings
from schemas.answer.first_order import Residual
from schemas.answer.loads import Loads
from schemas.answer.robust import Sensitivity
from schemas.base.model import Model
from schemas.base.target import pointer
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest

#: couples as API 618 names them
_COUPLES = ("horizontal couple (of the x forces)", "vertical couple (of the y forces)")
#: a share of what the machine shakes with that is worth a word
_NOTABLE = 1e-3
#: a throw whose webs balance less than this share of its rotating mass is bare
_BARE = 0.5
#: webs that make the span so many times that of the throws decide it
_FAR = 2.0
#: loads that differ by less than this share are alike; so are the ends of a closed bracket
_ALIKE = 1e-6
#: an optimum of which little errors cost this share of what it gains is fragile; of a plain counterweight a degree
#: costs 0.017 of it
_FRAGILE = 0.5
#: a peak that cancels to this share of what it is the sum of is rounding
_CANCELLED = 1e-9


@record(frozen=True)
class Evidence:
    """What there is to look at."""

    scene: Prepared
    unbalance: Complex | None  # (webs,) kg m; None where there are none to show
    fields: Mapping[str, Any]  # of the answer, by name: of its outputs
    proven: Mapping[str, Any]  # and of what is proven of the counterweights

    @cached_property
    def sizes(self) -> tuple[float, float]:
        """Sum of the centrifugal forces of all cranks [N], and that times the span [N m]."""
        masses, rows = self.scene.layout.rotating, self.scene.layout.reciprocating
        # in plain numbers, as of one machine they are few
        unbalance = sum(map(mul, masses.mass.tolist(), masses.radius.tolist()))
        unbalance += sum(map(mul, rows.mass.tolist(), rows.crank_radius.tolist()))
        force = unbalance * self.scene.omega_squared
        return force, force * float(span(self.scene.machine))


def cautions(
    scene: Prepared, unbalance: Complex | None, fields: Mapping[str, Any], proven: Mapping[str, Any]
) -> tuple[Caution, ...]:
    """All warnings of one machine, in a fixed order.

    Parameters
    ----------
    fields, proven : of the answer so far; proofs only in an answer with an optimum.
    """
    evidence = Evidence(scene, unbalance, fields, proven)
    return tuple(caution for watch in WATCHES for caution in watch(evidence))


def _plain(value: float, digits: int = 4) -> str:
    """Some digits without an exponent, as forces and moments are read: 107600, not 1.076e+05."""
    rounded = f"{value:.{digits}g}"
    return f"{float(rounded):.15g}" if "e" in rounded else rounded


def _no_gas(evidence: Evidence) -> Iterator[Caution]:
    """Rows without gas data in a request for loads with gas."""
    machine = evidence.scene.machine
    if not isinstance(machine, ReciprocatingMachine) or "piston_force" not in evidence.scene.simulated.times_ms:
        return
    rows = without_gas(machine)
    if rows:
        who = "1 row has no cylinder: its" if len(rows) == 1 else f"{len(rows)} rows have no cylinder: their"
        yield Caution(
            code="no_gas",
            message=f"{who} loads are those of inertia and friction alone.",
            pointer=pointer(("machine", *rows[0])),
        )


def _crosshead_lifts(evidence: Evidence) -> Iterator[Caution]:
    """Rows whose side force carries the crosshead to the upper guide, from which it falls at the dead centres."""
    loads: Loads | None = evidence.fields.get("loads")
    for row in () if loads is None else loads.rows:
        if row.guide is not None and row.guide.lifts:
            weight, up = row.guide.weight_N, row.guide.weight_N - row.guide.smallest_N
            yield Caution(
                code="crosshead_lifts",
                message=f"The crosshead of this row leaves its lower guide over {100.0 * row.guide.lifted_share:.3g} % "
                f"of the cycle: a side force of up to {_plain(up)} N against a weight of {_plain(weight)} N.",
                pointer=pointer(("machine", "throws", row.throw, "rows", row.row)),
            )


def _second_order(evidence: Evidence) -> Iterator[Caution]:
    """What counterweights on the shaft cannot change, where it is more than what they leave."""
    shafts = evidence.scene.layout.balance
    remedy = "no counterweight on the crank changes it."
    if shafts is not None:
        remedy = "balance shafts at twice the speed could change it."
    if shafts is not None and np.any(np.abs(shafts.ratio) == 2.0):
        remedy = "ask for all orders, so that the balance shafts at twice the speed count."
        request = evidence.scene.request
        if not isinstance(request, OptimizeRequest) or request.objective.orders == "all":
            remedy = "that is what the balance shafts at twice the speed leave."
    residual: Residual | None = evidence.fields.get("residual")
    first, second = (None, None) if residual is None or residual.orders.after is None else residual.orders.after
    if residual is None or first is None or second is None:
        return
    for kind, (quantity, left, twice, unit) in enumerate(
        (
            ("force", first.force.peak_N, second.force.peak_N, "N"),
            ("moment", first.moment.peak_Nm, second.moment.peak_Nm, "N m"),
        )
    ):
        if twice > left and twice > _NOTABLE * evidence.sizes[kind]:
            yield Caution(
                code="second_order_remains",
                message=f"A {quantity} of {_plain(twice)} {unit} remains at twice the shaft speed, more than the "
                f"{_plain(left)} {unit} at the speed itself: {remedy}",
                pointer="/machine/throws",
            )


def _bare_crank(evidence: Evidence) -> Iterator[Caution]:
    """External balance alone leaves the bearings to carry the rotating masses."""
    request, machine = evidence.scene.request, evidence.scene.machine
    if not isinstance(request, OptimizeRequest) or not isinstance(machine, ReciprocatingMachine):
        return
    goal = request.objective
    if evidence.unbalance is None or not machine.webs or goal.of_the_shaft:
        return
    rates: tuple[BalanceRate, ...] = evidence.fields["balance_rate"]
    bare = [(rate.rate, rate.throw) for rate in rates if rate.rate is not None and rate.rate < _BARE]
    if bare:
        rate, least = min(bare)
        name = machine.throws[least].name or str(least + 1)
        yield Caution(
            code="bare_crank",
            message=f"{len(bare)} of {len(machine.throws)} throws have less than half of their rotating mass balanced "
            f"by their own webs (throw {name}: {rate:z.2f}). What leaves the machine needs no more, but "
            "its main bearings carry the rest: ask for main_bearings, or weigh them.",
            pointer="/objective",
        )


def _component_grows(evidence: Evidence) -> Iterator[Caution]:
    """A component across the shaft that counterweights make larger."""
    residual: Residual | None = evidence.fields.get("residual")
    if residual is None or residual.after is None:
        return
    force, force_now = residual.before.force, residual.after.force
    moment, moment_now = residual.before.moment, residual.after.moment
    for quantity, unit, kind, axis, before, after in (
        ("force along x", "N", 0, "x", force.peak_x_N, force_now.peak_x_N),
        ("force along y", "N", 0, "y", force.peak_y_N, force_now.peak_y_N),
        (_COUPLES[0], "N m", 1, "x", moment.peak_x_Nm, moment_now.peak_x_Nm),
        (_COUPLES[1], "N m", 1, "y", moment.peak_y_Nm, moment_now.peak_y_Nm),
    ):
        if after > before and after > before + _NOTABLE * evidence.sizes[kind]:
            yield Caution.of_figures(
                {
                    "code": "component_grows",
                    "message": f"The {quantity} grows from {_plain(before)} to {_plain(after)} {unit}: weigh "
                    "that direction more if it matters.",
                    "pointer": f"/objective/direction_weights/{axis}",
                }
            )


def _far_web(evidence: Evidence) -> Iterator[Caution]:
    """A default weight of the moment that a web far from the throws decides."""
    request, machine = evidence.scene.request, evidence.scene.machine
    if not isinstance(request, OptimizeRequest) or not isinstance(machine, ReciprocatingMachine):
        return
    if request.objective.moment_weight is not None or not machine.webs:
        return
    planes = [throw.position_m for throw in machine.throws]
    own, whole = max(planes) - min(planes), float(span(machine))
    if own > 0.0 and whole > _FAR * own:
        middle = 0.5 * (max(planes) + min(planes))
        far = max(range(len(machine.webs)), key=lambda k: abs(machine.webs[k].position_m - middle))
        yield Caution(
            code="span_of_a_far_web",
            message=f"The moment is weighed with the span {_plain(whole)} m of throws and webs, which web "
            f"{machine.webs[far].name} makes {_plain(whole / own)} times that of the throws: give moment_weight.",
            pointer=f"/machine/webs/{far}/position_m",
        )


def _loads_grow(evidence: Evidence) -> Iterator[Caution]:
    """Bearing loads or bending moments above those of the bare or of the customary crank."""
    scene, machine = evidence.scene, evidence.scene.machine
    bearings: MainBearings | None = evidence.fields.get("main_bearings")
    if (
        bearings is None
        or evidence.unbalance is None
        or not isinstance(machine, ReciprocatingMachine)
        or not machine.webs
    ):
        return
    peaks = [bearing.after.peak_N for bearing in bearings.bearings if bearing.after]
    kinds: tuple[tuple[CautionCode, str, str, float, float], ...] = (
        (
            "bearing_load_grows",
            "bearing load",
            "N",
            max(peaks),
            max(bearing.before.peak_N for bearing in bearings.bearings),
        ),
        (
            "bending_moment_grows",
            "bending moment",
            "N m",
            max(bearings.bending.after_Nm or ()),
            max(bearings.bending.before_Nm),
        ),
    )
    usual = customary_peaks(scene, lambda: cranks(machine).customary)
    for (code, quantity, unit, now, bare), of_usual in zip(kinds, usual, strict=True):
        for than, of in ((bare, "without counterweights"), (of_usual, "of a crank balanced throw by throw")):
            if now > than * (1.0 + _ALIKE):
                yield Caution(
                    code=code,
                    message=f"The largest {quantity} is {_plain(now)} {unit}, above the {_plain(than)} {unit} {of}.",
                    pointer="/objective" if isinstance(scene.request, OptimizeRequest) else "/counterweights",
                )


def _not_closed(evidence: Evidence) -> Iterator[Caution]:
    """Peaks over the turn of which less is proven than a designer takes for granted."""
    if evidence.scene.peaks.is_closed(_ALIKE):
        return
    force, moment = evidence.sizes
    for output, field in evidence.fields.items():
        if not isinstance(field, Model) or not has_brackets(field.__class__):
            continue
        open_brackets = [(name, bracket) for name, bracket in brackets(field) if _is_wide(*bracket)]
        for unit, size in (("N", force), ("Nm", moment)):
            wide = [bracket for name, bracket in open_brackets if _of(name, unit)]
            if not wide:
                continue
            values = numbers(field)
            # of the same unit: what cancels between rows or bearings is as large in each of them
            most = max(float(np.max(np.abs(bracket), initial=size)) for name, bracket in values if _of(name, unit))
            open_ = [bracket for bracket in wide if _width(bracket) > _CANCELLED * most]
            if open_:
                low, high = max(open_, key=_width)
                yield Caution(
                    code="peak_not_closed",
                    message=f"A peak of {output} is proven only to lie between {_plain(low, 7)} and {_plain(high, 7)} "
                    f"{_SPOKEN[unit]}: it is too steep to be followed further.",
                    pointer="/machine",
                )


_SPOKEN = {"N": "N", "Nm": "N m"}


def _width(bracket: Sequence[float]) -> float:
    return bracket[1] - bracket[0]


def _is_wide(low: float, high: float) -> bool:
    return high - low > _ALIKE * max(abs(low), abs(high))


def _of(name: str, unit: str) -> bool:
    return name.endswith(f"_{unit}")


def _fragile(evidence: Evidence) -> Iterator[Caution]:
    """Counterweights of which little errors cost much of what they gain."""
    certificate: Certificate | None = evidence.proven.get("certificate")
    sensitivity: Sensitivity | None = evidence.proven.get("sensitivity")
    if certificate is None or sensitivity is None:
        return
    request = evidence.scene.request
    stated = isinstance(request, OptimizeRequest) and request.tolerances is not None
    gain = certificate.objective_without_counterweights - certificate.objective
    for error, rise in (
        ("One degree", sensitivity.objective_rise_per_deg),
        ("One per cent of mass", sensitivity.objective_rise_per_percent),
    ):
        if gain > 0.0 and rise > _FRAGILE * gain:
            yield Caution(
                code="fragile_optimum",
                message=f"{error} on all counterweights together may cost {_plain(rise)} of the {_plain(gain)} that "
                "they gain: large ones balance one another."
                + ("" if stated else " State tolerances, and what is best in their worst case is found."),
                pointer="/tolerances" if stated else "/objective",
            )
            return


#: what is looked at, in the order of the answer
Watch = Callable[[Evidence], Iterator[Caution]]
WATCHES: tuple[Watch, ...] = (
    _no_gas,
    _crosshead_lifts,
    _second_order,
    _bare_crank,
    _component_grows,
    _far_web,
    _loads_grow,
    _not_closed,
    _fragile,
)
