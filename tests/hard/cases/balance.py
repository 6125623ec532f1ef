"""Machines that balance themselves, nearly do, or are balanced completely by the optimum."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, machine, row, single_row, throw, v_twin, web


def cases() -> Iterator[Case]:
    yield from _by_itself()
    yield from _nearly()
    yield from _by_the_optimum()
    yield from _ordinary()


def _inline(cranks: list[float], pitch: float = 0.25, mass: float = 10.0) -> list[dict]:
    return [throw(pitch * k, angle, [row(90, mass)], rotating=4.0) for k, angle in enumerate(cranks)]


def _by_itself() -> Iterator[Case]:
    webs = [web("a", -0.2), web("b", 0.4), web("c", 1.0)]
    for name, cranks in (
        ("inline-4", [0, 180, 180, 0]),
        ("inline-6", [0, 120, 240, 240, 120, 0]),
        ("inline-8", [0, 180, 90, 270, 270, 90, 180, 0]),
    ):
        for combine in ("sum", "max"):
            yield case(
                f"balance/{name}-{combine}",
                "forces and moments cancel exactly: any gap relative to nothing is infinite",
                machine(_inline(cranks), webs),
                combine=combine,
                ordinary=True,
            )
    yield case(
        "balance/inline-3-force",
        "the force cancels exactly, the moment does not",
        machine(_inline([0, 120, 240]), webs),
        ordinary=True,
    )
    yield case(
        "balance/inline-3-force-alone",
        "only the force counts, and it cancels exactly",
        machine(_inline([0, 120, 240]), webs),
        moment_weight=0.0,
        ordinary=True,
    )
    yield case("balance/no-masses", "a machine without any mass", machine([throw(0, 0, [])], webs), ordinary=True)
    yield case(
        "balance/boxer-opposed-pins",
        "opposed rows on opposed pins in one plane",
        machine([throw(0, 0, [row(0, 7.0)]), throw(0, 180, [row(180, 7.0)])], webs),
        ordinary=True,
    )


def _nearly() -> Iterator[Case]:
    for error in (1e-3, 1e-6, 1e-9, 1e-12):
        throws = _inline([0, 120, 240, 240, 120, 0])
        throws[0]["rows"][0]["reciprocating_mass_kg"] *= 1 + error
        yield case(
            f"balance/inline-6-off-by-{error:g}",
            "what is left of the forces is the tolerance of one piston's mass: the rounding of the rest is near it",
            machine(throws, [web("a", -0.2), web("b", 0.4), web("c", 1.0)]),
            ordinary=error >= 1e-6,
        )
        throws = _inline([0, 180, 180, 0])
        throws[1]["crank_angle_deg"] += error
        yield case(
            f"balance/inline-4-angle-off-by-{error:g}",
            "a crank angle is off by its tolerance",
            machine(throws, [web("a", -0.2), web("b", 0.4), web("c", 1.0)]),
            combine="max",
        )


def _by_the_optimum() -> Iterator[Case]:
    yield case(
        "balance/v90",
        "equal masses in a right angle: the force vanishes at the optimum, where the norm has a kink",
        machine([throw(0, 45, [row(0, 10), row(90, 10)])], [web("a", 0.0)]),
        ordinary=True,
    )
    yield case(
        "balance/v90-two-webs",
        "force and moment vanish at the optimum together",
        machine([throw(0, 45, [row(0, 10), row(90, 10)])], [web("a", -0.2), web("b", 0.15)]),
        ordinary=True,
    )
    yield case(
        "balance/w60",
        "three rows 60 degrees apart: the force vanishes at the optimum",
        machine([throw(0, 10, [row(30, 10), row(90, 10), row(150, 10)])], [web("a", -0.1), web("b", 0.1)]),
        combine="max",
        ordinary=True,
    )
    for size in (5, 7):
        yield case(
            f"balance/star-{size}",
            "an even star: the counter-rotating force cancels exactly, the rest at the optimum",
            machine([throw(0, 0, [row(360.0 * k / size, 3.0) for k in range(size)])], [web("a", -0.1), web("b", 0.2)]),
        )
    rotor = [throw(-0.3, 10, [], rotating=3.0), throw(0.2, 200, [], rotating=5.0)]
    for combine in ("sum", "max"):
        yield case(
            f"balance/rotor-two-planes-{combine}",
            "two planes cancel a rotor's force and moment exactly: the optimum is 0",
            machine(rotor, [web("a", -0.4), web("b", 0.5)]),
            combine=combine,
            ordinary=True,
        )
        yield case(
            f"balance/rotor-eight-webs-{combine}",
            "eight webs cancel everything in a continuum of ways; one has the least mass",
            machine(rotor, [web(str(k), -0.5 + 0.13 * k, 2.0) for k in range(8)]),
            combine=combine,
            ordinary=True,
        )
    yield case(
        "balance/rotor-just-reached",
        "the limits are exactly what complete balance takes",
        machine([throw(0, 0, [], radius=0.125, rotating=8)], [web("a", -0.25, 4, 0.125), web("b", 0.25, 4, 0.125)]),
        ordinary=True,
    )
    yield case(
        "balance/rotor-just-missed",
        "the limits are a millionth short of what complete balance takes",
        machine(
            [throw(0, 0, [], radius=0.125, rotating=8)],
            [web("a", -0.25, 4 * (1 - 1e-6), 0.125), web("b", 0.25, 4 * (1 - 1e-6), 0.125)],
        ),
        ordinary=True,
    )
    yield case(
        "balance/force-vanishes-moment-does-not",
        "one web in the plane of the rotor, rows elsewhere on the shaft",
        machine([throw(0, 45, [row(0, 10), row(90, 10)]), throw(0.5, 0, [row(90, 2)])], [web("a", 0.0), web("b", 0.1)]),
        ordinary=True,
    )


def _ordinary() -> Iterator[Case]:
    """Plain machines: what a battery of hard cases must not forget."""
    pair = [web("a", -0.1), web("b", 0.6)]
    plain = {
        "single-row": machine(single_row(), [web("a", 0.0)]),
        "v-twin": machine(v_twin(), [web("a", -0.45), web("b", 0.55)]),
        "inline-3": machine(_inline([0, 120, 240]), pair),
        "inline-2-cw": machine(_inline([0, 90]), pair, rotation="cw"),
    }
    for name, body in plain.items():
        yield case(f"balance/{name}-sum", "plain: both peaks count", body, ordinary=True)
        # the smaller of the two peaks is free, unless there is only one to begin with
        unique = name in ("single-row", "v-twin")
        yield case(
            f"balance/{name}-max",
            "plain, with a kink where the peaks are equal",
            body,
            combine="max",
            ordinary=True,
            peaks_unique=unique,
        )
    yield case(
        "balance/single-row-least-mass-off",
        "the first stage alone",
        plain["single-row"],
        least_mass=False,
        ordinary=True,
    )
    yield case(
        "balance/inline-5-least-mass-off",
        "the first stage alone: the masses are free, and so are the peaks",
        machine(_inline([0, 72, 144, 216, 288]), [web(str(k), -0.1 + 0.2 * k, 5) for k in range(7)]),
        least_mass=False,
        peaks_unique=False,
    )
