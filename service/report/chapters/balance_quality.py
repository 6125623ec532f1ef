"""Balance quality of the shaft after ISO 21940-11."""

from collections.abc import Iterator

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.machine.machine import Machine
from service.report.blocks import Chapter, Paragraph, angle, table


def balance_quality(machine: Machine, answer: OptimizeAnswer | AnalyzeAnswer) -> Iterator[Chapter]:
    """Nothing for a machine without a grade."""
    result, demand = answer.balance_quality, machine.balance_quality
    if result is None or demand is None:
        return
    gradings = [("without counterweights", result.before)]
    if result.after is not None:
        gradings.append(("with counterweights", result.after))
    rows = [
        (label, name, plane.position_m, plane.permissible_kg_m, plane.unbalance_kg_m, angle(plane.angle_deg))
        for label, grading in gradings
        for name, plane in (("A", grading.plane_a), ("B", grading.plane_b))
    ]
    reached = "; ".join(f"{label} G {grading.grade_mm_s:.6g} mm/s" for label, grading in gradings)
    heads = ["", "plane", "#z, m", "#permissible, kg m", "#deviation, kg m", "#at, deg"]
    yield Chapter(
        "Balance quality",
        (
            Paragraph(f"Asked for: G {demand.grade_mm_s:.6g} mm/s. Reached: {reached}."),
            table("Deviation from the design unbalance, in which half of every reciprocating mass turns", heads, rows),
        ),
    )
