"""Loads of the anti-rotation pins of a scroll."""

from collections.abc import Iterator, Sequence

from schemas.scroll.losses import Losses
from schemas.scroll.pin_loads import Pin, PinLoads, PinLoadsAnswer, PinLoadsRequest
from service.common.figures import digits
from service.report.blocks import Block, Chapter, Equation, Figure, Paragraph, Table, angle, facts, table
from service.report.blocks import number as number_cell
from service.report.chapters.dynamics import figure
from service.report.charts import Line
from service.report.formula import formula
from service.tables.pins import dead_points, lines

#: about so many lines of a table over a revolution
_LINES = 18
#: columns of it
_MOST_PINS = 8


def pins(request: PinLoadsRequest, answer: PinLoadsAnswer) -> Iterator[Chapter]:
    """The answer to a request about pins alone."""
    yield pin_loads(answer, request.pins or ())


def pin_loads(loads: PinLoads, pins: Sequence[Pin] = ()) -> Chapter:
    """What the pins carry over a revolution, and whether they hold the scroll.

    Parameters
    ----------
    pins : the pins one by one, where the request names them; else they are even.
    """
    return Chapter("Pin loads", tuple(_blocks(loads, pins)))


def pin_figure(loads: PinLoads) -> Figure:
    """Load of every pin over a revolution."""
    lines = [Line(f"pin {pin.index}", pin.load_N) for pin in loads.pins]
    if loads.drive_bearing is not None:
        lines.append(Line("drive bearing", loads.drive_bearing.load_N))
    caption = "Load of the pins: the force on the orbiting scroll, positive along the eccentric."
    return figure("pin load", "N", loads.angle_deg, lines, caption)


def _blocks(loads: PinLoads, pins: Sequence[Pin]) -> Iterator[Block]:
    for warning in loads.warnings:
        yield Paragraph(warning.message[:1].upper() + warning.message[1:] + ".", "warning")
    equilibrium = loads.equilibrium
    if equilibrium.holds:
        yield Paragraph("The pins hold the scroll: moment and net force are in balance at every angle.")
    else:
        reason = f": {equilibrium.reason}" if equilibrium.reason else ""
        yield Paragraph(f"The pins do not hold the scroll at every angle{reason}.", "warning")
    if loads.peak_bracket_N is not None and all(warning.code != "peaks_not_certified" for warning in loads.warnings):
        yield Paragraph("Peaks are proven for every angle, not at the samples alone.")
    yield Equation(formula("Q_i = 2 T/(n R) sin(theta - 2π(i - 1)/n)   for n evenly spaced pins on radius R"))
    yield Paragraph(_assumption(pins))
    yield facts(
        "",
        [
            ("largest load of any pin, N", loads.peak_N),
            ("the same if members bore for half a revolution only, N", loads.half_turn_mechanism_peak_N),
            ("largest error of the moment, N m", equilibrium.max_moment_error_Nm),
            ("largest net force, N", equilibrium.max_net_force_N),
            *_of_drive(loads),
            ("work of the pins over one pitch, J", loads.energy.pins_work_J),
            ("work of the torque over one pitch, J", loads.energy.torque_work_J),
            ("dead points of all pins together, deg", ", ".join(map(digits, loads.dead_points_deg)) or "none"),
            ("degrees of freedom of the mechanism", loads.mechanism.degrees_of_freedom),
        ],
    )
    rows = [
        (
            str(pin.index),
            angle(pin.phase_deg),
            pin.peak_N,
            angle(pin.peak_angle_deg),
            pin.compression_from_deg,
            pin.compression_to_deg,
            pin.tension_from_deg,
            pin.tension_to_deg,
        )
        for pin in loads.pins
    ]
    heads = [
        "pin", "#sits at, deg", "#peak, N", "#at, deg", "#compression from, deg", "#to, deg", "#tension from, deg",
        "#to, deg",
    ]  # fmt: skip
    yield table("Pins", heads, rows)
    yield _data(loads, pins)
    yield pin_figure(loads)
    if len(loads.pins) <= _MOST_PINS:
        step = max(1, len(loads.angle_deg) // _LINES)
        titles, *cells = lines(loads, step)
        yield table("Q_i over the revolution", [f"#{title}" for title in titles], cells)
    if loads.comparison is not None:
        yield from _compared(loads, loads.comparison)
    turning = [Line("rotation torque", loads.rotation_torque_Nm)]
    if len(set(loads.rotation_torque_Nm)) > 1:
        yield figure("rotation torque", "N m", loads.angle_deg, turning, "Torque that turns the scroll about itself.")


def _assumption(pins: Sequence[Pin]) -> str:
    stated = any(pin.stiffness_N_per_m is not None for pin in pins)
    play = any(pin.clearance_m > 0 or pin.eccentricity_error_m != 0 for pin in pins)
    shared = "The stiffnesses below share the load." if stated else "Assumption: all pins have equal stiffness."
    return (
        f"T is the rotation torque, n the number of pins, R their radius, theta the shaft angle. {shared} "
        f"{'Clearances and errors of eccentricity are as below.' if play else 'No pin has clearance.'} "
        "At its dead points the crank of a pin lies along its radius and turns nothing; the other pins hold the scroll."
    )


def _data(loads: PinLoads, pins: Sequence[Pin]) -> Table:
    """What each pin is, and its dead points."""
    rows = []
    for number, pin in enumerate(loads.pins):
        stated = pins[number] if pins else None
        stiffness = (
            "equal" if stated is None or stated.stiffness_N_per_m is None else number_cell(stated.stiffness_N_per_m)
        )
        play = (0.0, 0.0) if stated is None else (stated.clearance_m, stated.eccentricity_error_m)
        rows.append((str(pin.index), *dead_points(pin.phase_deg), stiffness, *play))
    heads = [
        "pin", "#dead point, deg", "#and, deg", "#stiffness, N/m", "#clearance, m", "#error of eccentricity, m",
    ]  # fmt: skip
    return table("Dead points, stiffness and clearance", heads, rows)


def _of_drive(loads: PinLoads) -> Iterator[tuple[str, float | None]]:
    if loads.drive_bearing is not None:
        yield "largest load of the drive's bearing, N", loads.drive_bearing.peak_N


def _compared(loads: PinLoads, losses: Losses) -> Iterator[Block]:
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
    keys = [Line("in the frame", ring.frame_key_N), Line("in the scroll", first), Line("its opposite", second)]
    yield figure("key load", "N", loads.angle_deg, keys, "Keys of the Oldham ring, without the friction's own effect.")
