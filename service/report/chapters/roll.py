"""The roll moment on the frame."""

from schemas.answer.roll import Roll
from schemas.machine.machine import Machine
from service.report.blocks import Chapter, Paragraph, facts
from service.report.chapters.dynamics import figure
from service.report.charts import Line


def roll(_machine: Machine, found: Roll) -> Chapter:
    lines = [Line("without balance shafts", found.before.moment_Nm)]
    rows = [("without balance shafts, N m", found.before.peak_Nm)]
    if found.after is not None and found.after != found.before:
        lines.append(Line("with balance shafts", found.after.moment_Nm))
        rows.append(("with balance shafts, N m", found.after.peak_Nm))
    words = "About the crankshaft on the frame, of all orders, with gas and friction and without the mean."
    drawn = figure("roll moment", "N m", found.angle_deg, lines, "Roll moment on the frame.")
    return Chapter("Roll moment", (Paragraph(words), facts("Largest over the cycle", rows), drawn))
