"""Hard limits on the peaks: at the floor, a hair to either side, in conflict, at the reach of the webs."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, machine, row, single_row, throw, v_twin, web

# 10 kg at 0.1 m and 64 rad/s: the floor is half of m r omega^2, a power of two times a small number
_OMEGA = 64.0


def _floor() -> float:
    """Peak of the counter-rotating force of the single row, N."""
    return 0.5 * 10.0 * 0.1 * _OMEGA**2


def cases() -> Iterator[Case]:
    yield from _at_the_floor()
    yield from _at_the_reach()
    yield from _two()
    yield from _remaining()


def _at_the_floor() -> Iterator[Case]:
    webs = [web("a", 0.0)]
    for name, factor in (
        ("exactly-at", 1.0),
        ("1e-6-above", 1 + 1e-6),
        ("1e-9-above", 1 + 1e-9),
        ("1e-12-above", 1 + 1e-12),
        ("1e-3-below", 1 - 1e-3),
        ("1e-6-below", 1 - 1e-6),
        ("1e-9-below", 1 - 1e-9),
        ("1e-11-below", 1 - 1e-11),
    ):
        yield case(
            f"ceilings/floor-{name}",
            "the ceiling is at what no counterweights can remove, to within the digits given",
            machine(single_row(), webs, omega=_OMEGA),
            force_ceiling_N=_floor() * factor,
        )
        yield case(
            f"ceilings/floor-{name}-moment",
            "the same for the moment, which a pair of webs could otherwise cancel",
            machine(_couple(), [web("a", -0.4), web("b", 0.4)], omega=_OMEGA),
            moment_ceiling_Nm=0.6 * _floor() * factor,
            combine="max",
        )
    yield case(
        "ceilings/zero",
        "nothing may be left of a force that has a floor",
        machine(single_row(), webs, omega=_OMEGA),
        force_ceiling_N=0.0,
    )
    for name, ceiling in (("zero", 0.0), ("1e-12", 1e-12), ("1e-3", 1e-3)):
        yield case(
            f"ceilings/rotor-{name}",
            "a pure rotor can be balanced completely: a ceiling of 0 is met in one point",
            machine([throw(0.0, 33, [], rotating=3.0)], [web("a", -0.2), web("b", 0.1)], omega=_OMEGA),
            force_ceiling_N=ceiling,
            force_weight=0.0,
        )


def _couple() -> list[dict]:
    """Opposed cranks: no force, and a moment half of which is counter-rotating."""
    return [throw(-0.3, 90, [row(90, 10.0)]), throw(0.3, 270, [row(90, 10.0)])]


def _at_the_reach() -> Iterator[Case]:
    # 4 kg at 0.125 m on a rotor of 8 kg at 0.125 m: half of the force remains, whatever else
    rotor = [throw(0.0, 0.0, [], radius=0.125, rotating=8.0)]
    left = 4 * 0.125 * _OMEGA**2
    for name, factor in (
        ("exactly", 1.0),
        ("1e-9-above", 1 + 1e-9),
        ("1e-6-above", 1 + 1e-6),
        ("1e-6-below", 1 - 1e-6),
        ("1e-9-below", 1 - 1e-9),
    ):
        yield case(
            f"ceilings/reach-{name}",
            "the ceiling takes all that the limit allows: one point is left",
            machine(rotor, [web("a", 0.0, 4.0, 0.125)], omega=_OMEGA),
            force_ceiling_N=left * factor,
        )
        yield case(
            f"ceilings/budget-reach-{name}",
            "the ceiling takes the whole budget",
            machine(
                rotor, [web("a", -0.1, 9.0, 0.125), web("b", 0.1, 9.0, 0.125)], omega=_OMEGA, max_total_mass_kg=4.0
            ),
            force_ceiling_N=left * factor,
            least_mass=False,
        )
    yield case(
        "ceilings/wrong-way",
        "the ceiling asks for a little less than the force, and every sector points the wrong way",
        machine(rotor, [web("a", 0.0, 4.0, 0.125, (0, 80))], omega=_OMEGA),
        force_ceiling_N=8 * 0.125 * _OMEGA**2 * 0.999,
    )
    yield case(
        "ceilings/exactly-without-counterweights",
        "the ceiling is the force without counterweights, and the moment wants them",
        machine(v_twin(), [web("a", -0.4), web("b", 0.5)], omega=_OMEGA),
        force_ceiling_N=1.0e4,
        force_weight=0.0,
        peaks_unique=False,
    )


def _two() -> Iterator[Case]:
    for name, force, moment in (
        ("both-met", 6000.0, 3000.0),
        ("force-tight", 4300.0, 1e5),
        ("moment-tight", 1e5, 1500.0),
        ("conflict", 4300.0, 100.0),
        ("both-zero", 0.0, 0.0),
        ("never-binding", 1e30, 1e30),
        ("zero-and-1e30", 1e30, 0.0),
    ):
        for combine in ("sum", "max"):
            yield case(
                f"ceilings/two-{name}-{combine}",
                "two ceilings with one web for both of them" if combine == "sum" else "two ceilings beside two rows",
                machine(v_twin(), [web("a", -0.45, 3.0), web("b", 0.2, 6.0)], omega=_OMEGA),
                force_ceiling_N=force,
                moment_ceiling_Nm=moment,
                combine=combine,
            )


def _remaining() -> Iterator[Case]:
    yield case(
        "ceilings/no-webs-met",
        "ceilings that hold with nothing to choose",
        machine(v_twin(), [], omega=_OMEGA),
        force_ceiling_N=1e6,
    )
    yield case(
        "ceilings/no-webs-not-met",
        "ceilings that fail with nothing to choose",
        machine(v_twin(), [], omega=_OMEGA),
        force_ceiling_N=10.0,
    )
    yield case(
        "ceilings/only-the-other-response-counts",
        "the moment is to be small while the force is limited: they are bound only by the ceiling",
        machine(v_twin(), [web("a", -0.45, 3.0), web("b", 0.2, 6.0), web("c", 0.5, 1.0)], omega=_OMEGA, rotation="cw"),
        force_ceiling_N=5000.0,
        force_weight=0.0,
        direction_weights={"x": 0, "y": 1},
    )
    yield case(
        "ceilings/balanced-machine-zero",
        "a machine that balances itself under ceilings of 0",
        machine([throw(0.0, 0, [], rotating=3), throw(0.0, 180, [], rotating=3)], [web("a", 0.0), web("b", 0.1)]),
        force_ceiling_N=0.0,
        moment_ceiling_Nm=0.0,
    )
