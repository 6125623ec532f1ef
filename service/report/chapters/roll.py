"""The roll moment on the frame."""

from schemas.answer.roll import Roll
from schemas.machine.machine import Machine
from service.report.blocks import Chapter, Paragraph, facts
from service.report.chapters.dynamics import figure
from service.report.charts import Line


def roll(_machine: Machine, moments: Roll) -> Chapter:
    lines = [Line("without balance shafts", moments.before.moment_Nm)]
    rows = [("without balance shafts, N m", moments.before.peak_Nm)]
    if moments.after is not None and moments.after != moments.before:
        lines.append(Line("with balance shafts", moments.after.moment_Nm))
        rows.append(("with balance shafts, N m", moments.after.peak_Nm))
    words = "About the crankshaft on the frame, of all orders, with gas and friction and without the mean."
    curve = figure("roll moment", "N m", moments.angle_deg, lines, "Roll moment on the frame.")
    return Chapter("Roll moment", (Paragraph(words), facts("Largest over the cycle", rows), curve))
