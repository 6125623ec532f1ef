"""Loads of the anti-rotation pins of a scroll."""

from collections.abc import Iterator

from schemas.scroll.losses import Losses
from schemas.scroll.pin_loads import PinLoads, PinLoadsAnswer, PinLoadsRequest
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
            ("the same if members bore for half a revolution only, N", found.half_turn_mechanism_peak_N),
            ("largest error of the moment, N m", held.max_moment_error_Nm),
            ("largest net force, N", held.max_net_force_N),
            *_of_drive(found),
            ("work of the pins over one pitch, J", found.energy.pins_work_J),
            ("work of the torque over one pitch, J", found.energy.torque_work_J),
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
    if found.drive_bearing is not None:
        lines.append(Line("drive bearing", found.drive_bearing.load_N))
    caption = "Load of the pins: the force on the orbiting scroll, positive along the eccentric."
    yield figure("pin load", "N", found.angle_deg, lines, caption)
    if found.comparison is not None:
        yield from _compared(found, found.comparison)
    turning = [Line("rotation torque", found.rotation_torque_Nm)]
    yield figure("rotation torque", "N m", found.angle_deg, turning, "Torque that turns the scroll about itself.")


def _of_drive(found: PinLoads) -> Iterator[tuple[str, float | None]]:
    if found.drive_bearing is not None:
        yield "largest load of the drive's bearing, N", found.drive_bearing.peak_N


def _compared(found: PinLoads, losses: Losses) -> Iterator[Block]:
    ring = losses.oldham_ring
    yield facts(
        "Pins and an Oldham ring in their place",
        [
            ("friction loss of the pins, W", losses.pins_W),
            ("friction loss of the ring, W", ring.loss_W),
            ("loss of the pins over that of the ring", losses.ratio),
            ("largest load of a key, N", ring.peak_key_N),
            ("largest sliding speed, m/s", ring.peak_speed_m_s),
        ],
    )
    first, second = zip(*ring.scroll_keys_N, strict=True)
    lines = [Line("in the frame", ring.frame_key_N), Line("in the scroll", first), Line("its opposite", second)]
    yield figure("key load", "N", found.angle_deg, lines, "Keys of the Oldham ring, without the friction's own effect.")
