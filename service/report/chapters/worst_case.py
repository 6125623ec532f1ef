"""What the counterweights come to where things are off: scenarios, tolerances, and errors of a degree or a per cent."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Block, Chapter, Paragraph, facts, table


def worst_case(answer: OptimizeAnswer) -> Iterator[Chapter]:
    """Nothing where there are no counterweights to show."""
    blocks: list[Block] = []
    worst, price, off = answer.worst_case, answer.price_of_robustness, answer.sensitivity
    if worst is not None and price is not None:
        blocks.append(
            Paragraph(
                "What was made small is the worst of all scenarios, with everything off that may be, whichever way is "
                "worst. Each peak below is its largest by itself."
            )
        )
        rows = [
            ("peak force, N", worst.force_peak_N),
            ("peak moment, N m", worst.moment_peak_Nm),
            *((f"peak {response.label}, {response.unit}", response.peak) for response in worst.responses),
            ("peak load of a main bearing, N", worst.bearing_peak_N),
        ]
        blocks.append(facts("In the worst case", [(name, value) for name, value in rows if value is not None]))
        blocks.append(
            table(
                "The objective, and what the worst case costs",
                ["counterweights", "#unchanged machine", "#in the worst case"],
                [
                    ("those above", price.nominal, worst.objective),
                    ("best for the unchanged machine", price.nominal_optimum, price.nominal_optimum_worst_case),
                ],
            )
        )
    if off is not None:
        blocks.append(
            facts(
                "What the objective may rise by, at most, where all counterweights are off together",
                [
                    ("by up to one degree", off.objective_rise_per_deg),
                    ("by up to one per cent of their mass", off.objective_rise_per_percent),
                ],
            )
        )
    if blocks:
        yield Chapter("Where things are off", tuple(blocks))


def stated_cases(request: OptimizeRequest, subject: str = "objective") -> Iterator[Block]:
    """Scenarios and tolerances as they were stated; ``subject``: what the largest of counts."""
    if request.cases:
        yield table(
            f"Scenarios: the largest weighted {subject} counts",
            ["scenario", "#weight", "field", "#value"],
            [
                (scenario.name, scenario.weight, *change)
                for scenario in (case.scenario for case in request.cases)
                for change in (
                    [(field.path, field.value) for field in scenario.changes] or [("the unchanged machine", None)]
                )
            ],
        )
    if request.tolerances is not None:
        tolerances = request.tolerances
        yield facts(
            "Tolerances",
            [
                ("mass of a counterweight, share of it", tolerances.mass_relative),
                ("angle of a counterweight, deg", tolerances.angle_deg),
                ("unbalance besides at every web, kg m", tolerances.unbalance_kg_m),
                ("reciprocating mass of a row, share of it", tolerances.reciprocating_mass_relative),
            ],
        )
