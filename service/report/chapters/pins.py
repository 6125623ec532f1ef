"""Loads of the anti-rotation pins of a scroll."""

from collections.abc import Iterator

from schemas.scroll import PinLoads, PinLoadsAnswer, PinLoadsRequest
from service.report.blocks import Block, Chapter, Equation, Paragraph, digits, facts, table
from service.report.chapters.dynamics import figure
from service.report.charts import Line
from service.report.formula import formula


def loaded(_: PinLoadsRequest, answer: PinLoadsAnswer) -> Iterator[Chapter]:
    """The answer to a request about pins alone."""
    yield pin_loads(answer)


def pin_loads(found: PinLoads) -> Chapter:
    """What the pins carry over a turn, and whether they hold the scroll."""
    return Chapter("Pin loads", tuple(_blocks(found)))


def _blocks(found: PinLoads) -> Iterator[Block]:
    for warning in found.warnings:
        yield Paragraph(warning.message[:1].upper() + warning.message[1:] + ".", "warning")
    held = found.equilibrium
    if held.holds:
        yield Paragraph("The pins hold the scroll: moment and net force are in balance at every angle.")
    else:
        reason = f": {held.reason}" if held.reason else ""
        yield Paragraph(f"The pins do not hold the scroll at every angle{reason}.", "warning")
    yield Equation(formula("Q_i = 2 T/(n R) sin(theta - 2π(i - 1)/n)   for n evenly spaced pins on radius R"))
    yield facts(
        "",
        [
            ("largest load of any pin, N", found.peak_N),
            ("the same if members bore for half a turn only, N", found.half_turn_mechanism_peak_N),
            ("largest error of the moment, N m", held.max_moment_error_Nm),
            ("largest net force, N", held.max_net_force_N),
            ("dead points, deg", ", ".join(map(digits, found.dead_points_deg)) or "none"),
            ("degrees of freedom of the mechanism", found.mechanism.degrees_of_freedom),
        ],
    )
    rows = [
        (
            str(pin.index),
            pin.phase_deg,
            pin.peak_N,
            pin.peak_angle_deg,
            pin.compression_from_deg,
            pin.compression_to_deg,
            pin.tension_from_deg,
            pin.tension_to_deg,
        )
        for pin in found.pins
    ]
    heads = [
        "pin", "#sits at, deg", "#peak, N", "#at, deg", "#compression from, deg", "#to, deg", "#tension from, deg",
        "#to, deg",
    ]  # fmt: skip
    yield table("Pins", heads, rows)
    lines = [Line(f"pin {pin.index}", pin.load_N) for pin in found.pins]
    caption = "Load of the pins: the force on the orbiting scroll, positive along the eccentric."
    yield figure("pin load", "N", found.angle_deg, lines, caption)
    turning = [Line("rotation torque", found.rotation_torque_Nm)]
    yield figure("rotation torque", "N m", found.angle_deg, turning, "Torque that turns the scroll about itself.")
