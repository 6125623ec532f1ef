"""Loads as a designer of parts asks for them."""

from collections.abc import Iterator

from schemas.answer.loads import Loads
from schemas.machine.machine import Machine
from service.report.blocks import Block, Chapter, facts, table
from service.report.chapters.dynamics import figure
from service.report.chapters.inputs import row_name
from service.report.charts import Line


def loads(machine: Machine, output: Loads) -> Chapter:
    """Rods, pins, covers, frame, guides, base and bearings."""
    return Chapter("Loads of parts and base", tuple(_blocks(machine, output)))


def _blocks(machine: Machine, output: Loads) -> Iterator[Block]:
    rows_by_name = [(row_name(machine, row.throw, row.row), row) for row in output.rows]
    heads = ["row", "#reciprocating, kg", "#turning, kg", "#of the rod, kg"]
    masses = [
        (name, row.reciprocating_mass_kg, row.rotating_mass_kg, row.rod_rotating_mass_kg) for name, row in rows_by_name
    ]
    yield table("Masses", heads, masses)
    heads = [
        "row", "#gas, N", "#inertia, N", "#running, N", "#piston rod and pin, N", "governed by", "#crosshead pin, N",
    ]  # fmt: skip
    yield table(
        "Piston rod and pins: largest forces",
        heads,
        [
            (
                name, row.largest_gas_N, row.largest_inertia_N, row.largest_piston_force_N, row.piston_rod_N,
                row.piston_rod_governed_by, row.crosshead_pin_N,
            )
            for name, row in rows_by_name
        ],
    )  # fmt: skip
    heads = ["row", "#at the outer dead centre, N", "#at the inner dead centre, N", "#over the cycle, N"]
    yield table(
        "Sudden stop: gas alone",
        heads,
        [
            (name, row.stop_at_outer_dead_centre_N, row.stop_at_inner_dead_centre_N, row.stop_over_the_turn_N)
            for name, row in rows_by_name
        ],
    )
    covers = [
        (name, cover.cylinder + 1, cover.side, cover.largest_N, cover.smallest_N)
        for name, row in rows_by_name
        for cover in row.covers
    ]
    if covers:
        yield table("Covers and their bolts", ["row", "#cylinder", "end", "#largest, N", "#smallest, N"], covers)
    heads = ["row", "#tension, N", "#compression, N", "#mean, N", "#amplitude, N"]
    frames = [(name, row.frame) for name, row in rows_by_name]
    rows = [(name, frame.tension_N, frame.compression_N, frame.mean_N, frame.amplitude_N) for name, frame in frames]
    yield table("Frame and frame bolts, alternating", heads, rows)
    guides = [
        (name, row.guide.weight_N, row.guide.largest_N, row.guide.smallest_N, 100.0 * row.guide.lifted_share)
        for name, row in rows_by_name
        if row.guide is not None
    ]
    if guides:
        heads = ["row", "#weight, N", "#largest, N", "#smallest, N", "#off the lower guide, % of the cycle"]
        yield table("Crossheads on their lower guides, with their weight", heads, guides)
    yield facts(
        "Base",
        [
            ("mean torque, that of the driver, N m", output.driver_Nm),
            ("largest torque on a base of the machine's own, N m", output.own_base_peak_Nm),
            ("largest on a base shared with the driver, N m", output.shared_base_peak_Nm),
            ("weight of the machine on its foundation, N", output.foundation_weight_N),
        ],
    )
    if output.bearing_weights:
        weights = [(bearing.name, bearing.weight_N, bearing.x_N, bearing.y_N) for bearing in output.bearing_weights]
        yield table("Weight on the main bearings", ["bearing", "#weight, N", "#along x, N", "#along y, N"], weights)
    lines = [Line("torque less its mean", output.shared_base_Nm)]
    caption = "What leaves a base that machine and driver share; by Newton also the torque of the turning masses."
    yield figure("torque on a shared base", "N m", output.angle_deg, lines, caption)
