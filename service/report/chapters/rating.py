"""The thermal design of a compressor: the stages side by side, the totals, the warnings."""

from collections.abc import Callable, Iterator, Sequence

from schemas.rating.answer import Choice, RatingAnswer, StageRating, TandemLoads
from schemas.rating.request import RatingRequest
from service.report.blocks import Chapter, Paragraph, Table, facts, table

_FIGURES: tuple[tuple[str, str, Callable[[StageRating], float | None]], ...] = (
    ("cylinders", "", lambda stage: stage.cylinders),
    ("suction pressure, Pa", "nominal", lambda stage: stage.nominal.suction_pressure_Pa),
    ("", "corrected", lambda stage: stage.corrected.suction_pressure_Pa),
    ("", "in cylinder", lambda stage: stage.in_cylinder.suction_pressure_Pa),
    ("discharge pressure, Pa", "nominal", lambda stage: stage.nominal.discharge_pressure_Pa),
    ("", "corrected", lambda stage: stage.corrected.discharge_pressure_Pa),
    ("", "in cylinder", lambda stage: stage.in_cylinder.discharge_pressure_Pa),
    ("pressure ratio", "nominal", lambda stage: stage.nominal.pressure_ratio),
    ("", "in cylinder", lambda stage: stage.in_cylinder.pressure_ratio),
    ("pressure losses", "suction", lambda stage: stage.losses.suction),
    ("", "discharge", lambda stage: stage.losses.discharge),
    ("discharge temperature, K", "nominal", lambda stage: stage.nominal.discharge_temperature_K),
    ("", "in cylinder", lambda stage: stage.in_cylinder.discharge_temperature_K),
    ("", "polytropic", lambda stage: stage.polytropic_temperature_K),
    ("volumetric coefficient", "design", lambda stage: stage.design_coefficients.volumetric),
    ("", "actual", lambda stage: stage.actual_coefficients.volumetric),
    ("pressure coefficient", "", lambda stage: stage.actual_coefficients.pressure),
    ("temperature coefficient", "", lambda stage: stage.actual_coefficients.temperature),
    ("leakage coefficient", "", lambda stage: stage.actual_coefficients.leakage),
    ("condensate coefficient", "", lambda stage: stage.condensate_coefficient),
    ("delivery coefficient", "design", lambda stage: stage.design_coefficients.delivery),
    ("", "actual", lambda stage: stage.actual_coefficients.delivery),
    ("swept volume, m3", "calculated", lambda stage: stage.calculated.swept_volume_m3),
    ("", "actual", lambda stage: stage.actual.swept_volume_m3),
    ("bore, m", "calculated", lambda stage: stage.calculated.bore_m),
    ("", "actual", lambda stage: stage.actual.bore_m),
    ("gas load at outer dead centre, N", "nominal", lambda stage: stage.nominal_loads.outer.gas_force_N),
    ("", "in cylinder", lambda stage: stage.actual_loads.outer.gas_force_N),
    ("gas load at inner dead centre, N", "nominal", lambda stage: stage.nominal_loads.inner.gas_force_N),
    ("", "in cylinder", lambda stage: stage.actual_loads.inner.gas_force_N),
    ("indicated power, W", "", lambda stage: stage.indicated_power_W),
)


def _tandems(names: Sequence[str], tandems: Sequence[TandemLoads]) -> Iterator[Table]:
    """Rods that several pistons share."""
    if tandems:
        rows = [
            (
                " and ".join(names[number - 1] for number in tandem.stages),
                tandem.outer_N,
                tandem.inner_N,
                tandem.largest_N,
            )
            for tandem in tandems
        ]
        heads = ["stages", "#outer dead centre, N", "#inner dead centre, N", "#largest, N"]
        yield table("Gas loads of rods that several pistons share", heads, rows)


def rated(_: RatingRequest, answer: RatingAnswer) -> Iterator[Chapter]:
    """Stages, totals and warnings."""
    names = [stage.name or str(place) for place, stage in enumerate(answer.stages, 1)]
    rows = [(name, level, *map(figure, answer.stages)) for name, level, figure in _FIGURES]
    yield Chapter("Stages", (table("", ["", "", *(f"#{name}" for name in names)], rows),))
    totals = facts(
        "",
        [
            ("pressure ratio", answer.total_pressure_ratio),
            ("mean piston speed, m/s", answer.mean_piston_speed_m_s),
            ("capacity, m3/min", answer.capacity_m3_per_min),
            ("capacity over that asked for", answer.capacity_share),
            ("largest gas load of a rod, N", answer.largest_rod_load_N),
            ("indicated power, W", answer.indicated_power_W),
            ("shaft power, W", answer.shaft_power_W),
            ("motor power, W", answer.motor_power_W),
        ],
    )
    yield Chapter("Machine", (totals, *_tandems(names, answer.tandem_loads)))
    if answer.choice is not None:
        yield _choice(names, answer.choice)
    heads = ["stage", "loss at suction", "loss at discharge", "temperature coefficient"]
    stages = [(name, stage.sources) for name, stage in zip(names, answer.stages, strict=True)]
    sources = [
        (name, source.suction_pressure_loss, source.discharge_pressure_loss, source.temperature_coefficient)
        for name, source in stages
    ]
    yield Chapter("Sources of coefficients", (table("", heads, sources),))
    if answer.warnings:
        yield Chapter("Warnings", tuple(_warnings(answer)))


def _choice(names: Sequence[str], choice: Choice) -> Chapter:
    """The designs on the way to rods and motor that suffice."""
    heads = [
        "#design", "#speed, rpm", *(f"#rod {name}, m" for name in names), *(f"#load {name}, N" for name in names),
        "#motor needed, W",
    ]  # fmt: skip
    rows = [
        (number, step.speed_rpm, *step.piston_rod_diameters_m, *step.rod_loads_N, step.motor_power_W)
        for number, step in enumerate(choice.steps, 1)
    ]
    words = "Rods and motor from the tables of the request: the design is done over until both suffice."
    motor = facts("", [("motor, W", choice.motor_power_W), ("speed of the shaft, rpm", choice.speed_rpm)])
    return Chapter("Choice", (Paragraph(words), table("", heads, rows), motor))


def _warnings(answer: RatingAnswer) -> Iterator[Paragraph]:
    for warning in answer.warnings:
        place = (
            "machine" if warning.stage is None else f"stage {answer.stages[warning.stage - 1].name or warning.stage}"
        )
        yield Paragraph(f"{place}: {warning.message}", "warning")
