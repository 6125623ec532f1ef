"""Masses, radii and speeds of all sizes, across machines and in one machine."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, four_webs, machine, row, scroll, single_row, throw, v_twin, web


def cases() -> Iterator[Case]:
    yield from _across_machines()
    yield from _in_single_machine()
    yield from _scrolls()


def _across_machines() -> Iterator[Case]:
    for power in (-9, -6, -3, 0, 3, 6):
        scale = 10.0**power
        yield case(
            f"sizes/masses-1e{power}",
            "all masses of one odd size: absolute tolerances of a solver would be met at once, or never",
            machine(v_twin(scale), four_webs(scale)),
            ordinary=True,
        )
    for radius in (1e-6, 1e-4, 1e-2, 1.0, 10.0):
        yield case(
            f"sizes/crank-radius-{radius:g}",
            "the unbalance is that of the crank radius while limits and planes keep their size",
            machine(v_twin(radius=radius), four_webs(radius / 0.1)),
            ordinary=True,
        )
        yield case(
            f"sizes/crank-radius-{radius:g}-limits-of-other-size",
            "the limits of the webs are far larger or far smaller than the unbalance",
            machine(v_twin(radius=radius), four_webs()),
            combine="max",
        )
    for omega in (1e-2, 1.0, 1e2, 1e4, 1e5):
        yield case(
            f"sizes/speed-{omega:g}",
            "forces grow with the square of the speed, over fourteen powers of ten",
            machine(v_twin(), four_webs(), omega=omega),
            ordinary=True,
        )
        # at that speed what four kilograms at 0.2 m leave of the force is a firm ceiling
        yield case(
            f"sizes/speed-{omega:g}-ceiling",
            "the ceiling is in newtons and scales with the square of the speed, as the responses do",
            machine(v_twin(), [web("a", -0.45), web("d", 0.55)], omega=omega),
            force_ceiling_N=1.3 * omega**2,
            force_weight=0.0,
        )
    for name, scale, radius, omega in (("tiny", 1e-9, 1e-6, 1e-2), ("huge", 1e6, 10.0, 1e5), ("fast", 1e-9, 1e-6, 1e5)):
        yield case(
            f"sizes/everything-{name}",
            "masses, radius and speed all at the end of their range: forces from 1e-19 to 1e17 N",
            machine(v_twin(scale, radius=radius), four_webs(scale * radius / 0.1), omega=omega),
            ordinary=True,
        )


def _in_single_machine() -> Iterator[Case]:
    wide = [1e-9, 1e6]
    for first, second in (wide, wide[::-1]):
        yield case(
            f"sizes/rows-{first:g}-and-{second:g}",
            "fifteen powers of ten between two rows of one machine: the small one is below the other's rounding",
            machine([throw(-0.3, 0, [row(90, first)]), throw(0.3, 100, [row(90, second)])], _limits(1e6)),
        )
    yield case(
        "sizes/rows-1e-9-and-1e6-opposite-webs-small",
        "the webs can carry what the small row needs, and nothing of what the large one needs",
        machine([throw(-0.3, 0, [row(90, 1e-9)]), throw(0.3, 100, [row(90, 1e6)])], _limits(1e-9)),
    )
    yield case(
        "sizes/ladder-of-masses",
        "sixteen throws whose masses grow by ten from one to the next",
        machine(
            [throw(0.1 * k, 67.0 * k, [row(90, 10.0 ** (k - 9))], rotating=10.0 ** (6 - k)) for k in range(16)],
            _limits(1e6, 0.0, 1.5),
        ),
    )
    yield case(
        "sizes/light-row-on-heavy-rotor",
        "the rotating mass is cancelled to 1e-15 of itself before the row's share shows",
        machine([throw(0.0, 30, [row(90, 1e-9)], rotating=1e6)], [web("a", 0.0, 1e7)]),
    )
    yield case(
        "sizes/radii-1e-6-and-10",
        "crank radii of 1e-6 m and 10 m side by side, with the masses the other way round",
        machine(
            [throw(-0.3, 0, [row(90, 1e6)], radius=1e-6), throw(0.3, 100, [row(90, 0.1)], radius=10.0)], _limits(1e3)
        ),
        ordinary=True,
    )
    yield case(
        "sizes/web-radii-1e-6-and-10",
        "one web carries ten million times the unbalance of the other for the same mass",
        machine(v_twin(), [web("a", -0.4, 100.0, 1e-6), web("b", 0.5, 100.0, 10.0), web("c", 0.1, 100.0, 1e-3)]),
    )
    yield case(
        "sizes/web-limits-1e-9-to-1e6",
        "limits over fifteen powers of ten; the answer mixes webs that are full with webs that are hardly used",
        machine(v_twin(), [web(str(k), -0.5 + 0.07 * k, 10.0 ** (k - 9)) for k in range(16)]),
    )
    yield case(
        "sizes/row-hardly-there",
        "the row is 1e-12 of the rotating mass: the floor is below the rounding of the force",
        machine([throw(0.0, 30, [row(90, 1e-12)], rotating=1.0)], [web("a", -0.2), web("b", 0.1)]),
    )
    for span in (1e-6, 1e3):
        planes = [throw(-0.3 * span, 0, [row(90, 12.0)]), throw(0.4 * span, 130, [row(90, 7.0)], rotating=3)]
        yield case(
            f"sizes/span-{span:g}",
            "the axial span sets the weight of the moment and the size of every arm",
            machine(planes, [web("a", -0.45 * span, 3.0), web("b", 0.25 * span, 2.0), web("d", 0.55 * span, 6.0)]),
            ordinary=True,
        )
    yield case(
        "sizes/limit-far-below-need",
        "a web limit of 1e-9 kg against an unbalance of kilograms: the gain is 1e-9 of the objective",
        machine(single_row(), [web("a", 0.0, 1e-9)]),
        ordinary=True,
    )


def _limits(mass: float, low: float = -0.5, high: float = 0.5) -> list[dict]:
    return [web("a", low, mass), web("b", high, mass), web("c", 0.5 * (low + high) + 0.07, mass)]


def _scrolls() -> Iterator[Case]:
    oldham = {"type": "oldham", "mass_kg": 0.35, "axis_deg": 30, "position_m": 0.03}
    pins = {
        "type": "crank_pins",
        "count": 3,
        "pin_circle_radius_m": 0.05,
        "eccentric_mass_kg": 0.02,
        "position_m": 0.03,
    }
    places = [web("top", 0.08, 1.0, 0.02), web("bottom", -0.06, 1.0, 0.02)]
    yield case("sizes/scroll-oldham", "one orbiting mass and one ring", scroll(places, oldham), ordinary=True)
    yield case(
        "sizes/scroll-pins-cancel-exactly",
        "everything turns with the shaft: force and moment vanish at the optimum",
        scroll(places, pins),
        ordinary=True,
    )
    yield case(
        "sizes/scroll-orbit-1e-6",
        "an orbit of a micrometre at 1e5 rad/s",
        scroll(places, oldham, orbit=1e-6, omega=1e5, rotation="cw"),
        ordinary=True,
    )
    yield case(
        "sizes/scroll-ring-1e6-scroll-1e-9",
        "the ring is fifteen powers of ten heavier than the scroll",
        scroll([web("top", 0.08, 1e6, 0.02), web("bottom", -0.06, 1e6, 0.02)], {**oldham, "mass_kg": 1e6}, mass=1e-9),
    )
    yield case(
        "sizes/scroll-max-directions",
        "the larger of two weighted peaks with four norm terms",
        scroll(places, oldham, rotation="cw"),
        combine="max",
        direction_weights={"x": 1, "y": 1e-8},
    )
