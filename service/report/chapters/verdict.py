"""The verdict: the answer in plain words and a few figures, and its proof."""

from collections.abc import Iterator, Mapping

from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.answer.infeasibility import Infeasibility
from schemas.answer.limits import CeilingField
from schemas.base.responses import ceilings
from schemas.request.objective import COSTS
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Block, Chapter, Equation, Formula, Paragraph, Run, facts, figure_beside, prose, table
from service.report.chapters.balance import best_set, best_set_label, response_rows
from service.report.chapters.built import decision
from service.report.chapters.limits import limits, without_prices
from service.report.chapters.resolution import resolutions
from service.report.formula import formula
from service.tables.as_built import AsBuilt

_CEILINGS: Mapping[CeilingField, str] = {
    **{ceiling.field: ceiling.label for ceiling in ceilings()},
    "bearing_ceiling_N": "bearing loads",
    "specific_load_ceiling_Pa": "specific bearing loads",
    "bending_ceiling_Nm": "bending moments",
}


def result(request: OptimizeRequest, answer: OptimizeAnswer, built: AsBuilt | None) -> Chapter:
    """The answer in plain words and a few figures."""
    was, (_, left) = answer.residual.before, best_set(answer)
    if answer.infeasibility is not None:
        words: list[Block] = list(reachable(request, answer.infeasibility))
    else:
        words = [_certified(request, answer)]
    if built is not None:
        return Chapter("Result", (*words, *decision(answer, built)))
    force, moment = was.force.peak_N, was.moment.peak_Nm
    gaps, floor = resolutions(request, answer), answer.floor
    left_force = figure_beside(left.force.peak_N if left else None, force, gaps.get("force", 0.0))
    left_moment = figure_beside(left.moment.peak_Nm if left else None, moment, gaps.get("moment", 0.0))
    rows = [
        ("peak force, N", force, left_force, figure_beside(floor.force_N, force)),
        ("peak moment, N m", moment, left_moment, figure_beside(floor.moment_Nm, moment)),
        *response_rows(answer, gaps),
    ]
    heads = ["quantity", "#without counterweights", f"#{best_set_label(answer)}", "#floor"]
    figures = table("First-order peaks over a revolution", heads, rows)
    return Chapter("Result", (*words, figures, *_total(answer)))


def _total(answer: OptimizeAnswer) -> Iterator[Block]:
    if answer.total_mass_kg is not None:
        rows: list[tuple[str, float | str]] = [("total mass of the counterweights, kg", answer.total_mass_kg)]
        if answer.balance_shafts_mass_kg is not None:
            rows.append(("total mass on the balance shafts, kg", answer.balance_shafts_mass_kg))
        if answer.active_limits:
            rows.append(("limits of the machine reached", limits(answer.active_limits)))
        yield facts("", rows)


def _certified(request: OptimizeRequest, answer: OptimizeAnswer) -> Paragraph:
    proof = answer.certificate
    assert proof is not None  # only an infeasible answer has none
    if not request.machine.webs and not answer.balance_shafts:
        return Paragraph("The machine has no web for counterweights, so there is nothing to choose.", "key")
    if proof.lower_bound is None or proof.relative_gap is None:
        return Paragraph(f"Nothing is proven of the counterweights below. {answer.status_reason}", "warning")
    if answer.status == "inaccurate":
        return Paragraph(
            "Inaccurate: the counterweights below keep the limits, and their gap to the optimum is proven. It is "
            f"at most {_percent(proof.relative_gap)} of the objective without counterweights; "
            f"{_percent(request.accuracy.relative_gap)} was requested. {answer.status_reason} See the certificate.",
            "warning",
        )
    costs = any(goal.goal in COSTS for goal in proof.goals)
    left = " It is what this goal leaves to those after it, at most its allowance." if costs else ""
    return Paragraph(
        "Certified: no counterweights within these limits bring the objective below "
        f"{prose(proof.lower_bound)}, and those listed reach {prose(proof.objective)}. The difference is "
        f"{_percent(proof.relative_gap)} of the objective without counterweights.{left}",
        "key",
    )


def _percent(share: float) -> str:
    return "less than 0.00001 %" if 0 < share < 1e-7 else f"{100 * share:.2g} %"


def reachable(request: OptimizeRequest, why: Infeasibility) -> Iterator[Block]:
    """Which ceilings cannot be met, and what can be reached."""
    goal = request.objective
    names = " and ".join(f"the ceiling of the {_CEILINGS[name]}" for name in why.conflict)
    together = "cannot be met together" if len(why.conflict) > 1 else "cannot be met"
    yield Paragraph(
        f"Proven infeasible: {names} {together} by any counterweights within the limits of the webs. The report shows "
        "the best compromise, whose largest excess over the ceilings is smallest.",
        "warning",
    )
    if why.scenarios:
        yield Paragraph(f"The ceilings of the scenarios {', '.join(why.scenarios)} conflict.", "warning")
    closest = why.closest.first_order
    worst = _worst_case(request)
    # such a peak stands above that of the compromise, which is of the first order of the unchanged machine
    every = _of_all_orders(request)
    kind = f"{every and ', first order'}{worst and ', on the unchanged machine'}"
    yield table(
        f"Smallest feasible peaks{every}{worst}",
        ["case", "#peak force, N", "#peak moment, N m"],
        [
            ("ceiling", goal.force_ceiling_N, goal.moment_ceiling_Nm),
            ("smallest, without the other ceiling", why.smallest_force_N, why.smallest_moment_Nm),
            ("certified not below", why.smallest_force_lower_bound_N, why.smallest_moment_lower_bound_Nm),
            (f"best compromise{kind}", closest.force.peak_N, closest.moment.peak_Nm),
        ],
    )
    if why.smallest:
        yield table(
            f"Other responses under a ceiling, each by itself{worst}",
            ["response", "ceiling of the", "unit", "#ceiling", "#smallest", "#certified not below"],
            [
                (
                    minimum.response,
                    *_of_ceiling(minimum.ceiling_field),
                    minimum.ceiling,
                    minimum.smallest,
                    minimum.lower_bound,
                )
                for minimum in why.smallest
            ],
        )


def _of_all_orders(request: OptimizeRequest) -> str:
    return " of all orders" if request.objective.orders == "all" else ""


def _worst_case(request: OptimizeRequest) -> str:
    return ", in the worst case" if request.robust else ""


def _of_ceiling(field: CeilingField) -> tuple[str, str]:
    """What a ceiling limits, and its unit."""
    if field == "specific_load_ceiling_Pa":
        # two ceilings of one bearing stand side by side as loads
        return f"{_CEILINGS[field]}, times diameter and length", "N"
    return _CEILINGS[field], "N m" if field.endswith("_Nm") else "N"


def certificate(request: OptimizeRequest, answer: OptimizeAnswer) -> Chapter:
    """The proof, in plain words and in figures."""
    title, proof, why = "Certificate", answer.certificate, answer.infeasibility
    if proof is None:
        assert why is not None  # an answer without a certificate is infeasible
        every = _of_all_orders(request)
        return Chapter(
            title,
            (
                Paragraph(
                    "A lower bound in closed form on the smallest excess over the ceilings is above zero, which proves "
                    f"that no counterweights satisfy them. Bounds of the same kind certify the smallest peaks{every}, "
                    f"each without the other ceiling{_worst_case(request)}: the force is never below "
                    f"{prose(why.smallest_force_lower_bound_N)} N and the moment never below "
                    f"{prose(why.smallest_moment_lower_bound_Nm)} N m."
                ),
            ),
        )
    words = (
        f"Without counterweights the objective is {prose(proof.objective_without_counterweights)}. The counterweights "
        f"bring it to {prose(proof.objective)}, recomputed from their masses and angles. "
    )
    if proof.lower_bound is None or proof.relative_gap is None:
        words += "No lower bound is proven."
    else:
        words += (
            f"{_bound_words(proof)} bring it below "
            f"{prose(proof.lower_bound)}. Other counterweights gain at most {_percent(proof.relative_gap)} of the "
            "objective without counterweights."
        )
    blocks: list[Block] = [Paragraph(words), _bound()]
    rows: list[tuple[str, float | str | None]] = [
        ("objective without counterweights", proof.objective_without_counterweights),
        ("objective", proof.objective),
        ("lower bound", proof.lower_bound),
        ("gap", proof.gap),
        ("relative gap", proof.relative_gap),
        ("relative to", proof.yardstick),
    ]
    if proof.nodes is not None:
        rows.append(("lower bound for any masses and angles", proof.continuous_lower_bound))
        rows.append(("nodes of the tree", proof.nodes))
    if proof.mass_lower_bound_kg is not None:
        blocks.append(
            Paragraph(
                f"Among all counterweights that reach this objective, none weigh less than "
                f"{prose(proof.mass_lower_bound_kg)} kg together, by the same kind of bound."
            )
        )
        rows += [
            ("lower bound of the total mass, kg", proof.mass_lower_bound_kg),
            ("relative gap of the mass", proof.mass_relative_gap),
            ("relative to, kg", proof.mass_yardstick_kg),
        ]
    rows.append(("method", proof.method))
    if proof.cuts is not None:
        rows += [("cuts", proof.cuts), ("programs solved", proof.rounds)]
    blocks.append(facts("", rows))
    if proof.goals:
        met = [(goal.goal, goal.value, goal.lower_bound, goal.limit, goal.limit - goal.value) for goal in proof.goals]
        heads = ["goal", "#value", "#lower bound", "#limit for the later goals", "#allowance left"]
        blocks.append(table("Goals in their order", heads, met))
    return Chapter(title, (*blocks, *without_prices(request, answer)))


def _bound_words(proof: Certificate) -> str:
    if proof.nodes is None:
        return "A lower bound in closed form shows that no counterweights within these limits"
    by = f"Branch and bound with {proof.nodes} nodes over" if proof.nodes else "The comparison of"
    return f"{by} all sets of counterweights shows that none"


def _bound() -> Equation:
    """docs/mathematics.md section 5."""
    runs: Formula = formula("P(u) >= sum lambda_r (floor_r + sum Re(y_j* a_j(u))) = const + sum Re(w_k* u_k)")
    return Equation((*runs, Run(",   |y"), Run("j", "sub"), Run("| ≤ 1, λ ≥ 0, Σ λ = 1")))
