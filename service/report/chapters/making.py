"""What a workshop has to know of counterweights beside masses, angles, planes and radii: bolts, outlines."""

from collections.abc import Iterator, Sequence

from schemas.answer.counterweights import Counterweight
from schemas.machine.machine import Machine
from service.common.figures import digits
from service.report.blocks import Block, table


def holding(machine: Machine, fitted: Sequence[Counterweight]) -> Iterator[Block]:
    """Loads on bolts, if the machine has such a limit; but for plates."""
    whole = [counterweight for counterweight in fitted if counterweight.mass_kg > 0 and counterweight.shape is None]
    limits = (web.max_centrifugal_force_N for web in machine.every_web)
    bolted = machine.overspeed_rpm is not None or any(limit is not None for limit in limits)
    if whole and bolted:
        rows = [(counterweight.web, counterweight.centrifugal_force_N) for counterweight in whole]
        title = f"What holds them at {digits(machine.overspeed_rpm or machine.speed_rpm)} rpm"
        yield table(title, ["web", "#bolts hold, N"], rows)


def outlines(fitted: Sequence[Counterweight]) -> Iterator[Block]:
    """What is cut from plates, one row for each web that has one."""
    rows = [
        (
            item.web, item.shape.half_angle_deg, item.shape.chord_height_m, item.radius_m, item.shape.outer_radius_m,
            item.shape.inertia_kg_m2, item.centrifugal_force_N,
        )
        for item in fitted
        if item.shape is not None
    ]  # fmt: skip
    if rows:
        heads = [
            "web", "#half opening, deg", "#chord from the shaft, m", "#centre of mass, m", "#clearance radius, m",
            "#inertia, kg m²", "#bolts hold, N",
        ]  # fmt: skip
        yield table("Cut from their plates", heads, rows)
