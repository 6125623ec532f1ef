"""Limits of the webs: none at all, of all sizes, sectors of all widths, budgets."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, four_webs, machine, row, single_row, throw, v_twin, web


def cases() -> Iterator[Case]:
    yield from _masses()
    yield from _sectors()
    yield from _wrong_way()
    yield from _budgets()


def _masses() -> Iterator[Case]:
    yield case("limits/no-webs", "nothing to choose", machine(v_twin(), []), ordinary=True)
    yield case(
        "limits/all-zero",
        "webs that cannot carry anything: the program has no interior",
        machine(v_twin(), [web("a", -0.4, 0.0), web("b", 0.4, 0.0)]),
        ordinary=True,
    )
    yield case(
        "limits/one-zero",
        "one limit of 0 among others",
        machine(v_twin(), [web("a", -0.4, 0.0), web("b", 0.4, 3.0), web("c", 0.1, 0.0, 0.2, (10, 20))]),
        ordinary=True,
    )
    for combine in ("sum", "max"):
        yield case(
            f"limits/1e-12-and-1e12-{combine}",
            "limits twenty-four powers of ten apart side by side",
            machine(v_twin(), [web("a", -0.4, 1e-12), web("b", 0.4, 1e12), web("c", -0.2, 1e12), web("d", 0.2, 1e-12)]),
            combine=combine,
            ordinary=combine == "sum",
        )
    yield case(
        "limits/1e-12-and-1e12-thin-sectors",
        "limits twenty-four powers of ten apart in sectors of a thousandth of a degree",
        machine(
            v_twin(),
            [web(str(k), -0.4 + 0.2 * k, 10.0 ** (12 * (-1) ** k), 0.2, (170 + 7 * k, 1e-3)) for k in range(5)],
        ),
    )
    for scale in (1e-12, 1e12, 1e-6):
        yield case(
            f"limits/all-{scale:g}",
            "limits that allow next to nothing, or that can never bind",
            machine(v_twin(), four_webs(scale)),
            ordinary=scale > 1,
        )
    yield case(
        "limits/exactly-what-is-needed",
        "the limit of the web is the optimum to the last bit",
        machine(single_row(10.0), [web("a", 0.0, 2.5, 0.2)]),
        ordinary=True,
    )


def _sectors() -> Iterator[Case]:
    for half in (1e-6, 1e-3, 1.0, 45.0, 89.999999, 90.0):
        webs = [
            web("a", -0.4, 9, 0.2, (185, half)),
            web("b", 0.1, 9, 0.2, (250, half)),
            web("c", 0.5, 9, 0.2, (310, half)),
        ]
        yield case(
            f"limits/sector-{half}",
            "a sector of almost no width, or one whose tangent is infinite",
            machine(v_twin(), webs),
            ordinary=half >= 1e-3,
        )
        yield case(
            f"limits/sector-{half}-edge-on-optimum",
            "the free optimum lies exactly on the edge of the sector",
            machine(single_row(), [web("a", 0.0, 9, 0.2, (270 + half, half))]),
            ordinary=True,
        )
    for half in (1e-6, 90.0):
        yield case(
            f"limits/sector-{half}-max-directions",
            "extreme sectors with four norm terms and the larger of two peaks",
            machine(v_twin(), [web(str(k), -0.4 + 0.2 * k, 4, 0.2, (80 * k, half)) for k in range(5)]),
            combine="max",
            direction_weights={"x": 1, "y": 0.1},
        )
    yield case(
        "limits/sectors-of-all-widths",
        "sectors from a millionth of a degree to a half-disc in one machine",
        machine(
            v_twin(),
            [
                web(str(k), -0.4 + 0.15 * k, 3.0, 0.2, (150 + 40 * k, half))
                for k, half in enumerate((1e-6, 1e-4, 1e-2, 1.0, 30.0, 90.0))
            ],
        ),
    )
    yield case(
        "limits/sector-thin-far-turns",
        "the centre of the sector is given as ten thousand turns and a bit",
        machine(v_twin(), [web("a", -0.4, 9, 0.2, (-359815.0, 1e-3)), web("b", 0.5, 9, 0.2, (360310.0, 1e-3))]),
        ordinary=True,
    )


def _wrong_way() -> Iterator[Case]:
    for half in (1e-6, 10.0, 89.0):
        yield case(
            f"limits/wrong-way-{half:g}",
            "every sector points along the unbalance: no counterweights are the best ones, and the sectors' apex",
            machine([throw(0.0, 0.0, [], rotating=4.0)], [web(str(k), 0.0, 5, 0.2, (0, half)) for k in range(3)]),
            ordinary=True,
        )
    yield case(
        "limits/wrong-way-exactly-perpendicular",
        "the best direction is the very edge of a half-disc, where it gains nothing to first order",
        machine([throw(0.0, 0.0, [], rotating=4.0)], [web("a", 0.0, 5, 0.2, (0, 90))]),
        ordinary=True,
    )
    yield case(
        "limits/wrong-way-by-a-hair",
        "the edge of the sector gains a millionth: nearly nothing is optimal",
        machine([throw(0.0, 0.0, [], rotating=4.0)], [web("a", 0.0, 5, 0.2, (45, 45.0001))]),
        ordinary=True,
    )
    yield case(
        "limits/wrong-way-but-couple",
        "along the force every sector points the wrong way; the moment wants them all the same",
        machine(
            [throw(-0.3, 0, [], rotating=4), throw(0.3, 180, [], rotating=4)],
            [web("a", -0.4, 5, 0.2, (0, 60)), web("b", 0.4, 5, 0.2, (0, 60))],
        ),
        ordinary=True,
    )


def _budgets() -> Iterator[Case]:
    for budget in (0.0, 1e-12, 1e-3, 1.0, 1e12):
        yield case(
            f"limits/budget-{budget:g}",
            "a budget of nothing, of a speck, or one that never binds",
            machine(v_twin(), four_webs(), max_total_mass_kg=budget),
            ordinary=budget not in (1e-12,),
        )
    # a single row of 10 kg at 0.1 m takes 2.5 kg at 0.2 m: half its mass-radius product
    for name, budget in (("exactly", 2.5), ("hair-below", 2.5 * (1 - 1e-9)), ("hair-above", 2.5 * (1 + 1e-9))):
        yield case(
            f"limits/budget-{name}-optimum",
            "the budget is the mass of the optimum: limit and optimum coincide",
            machine(single_row(), [web("a", 0.0)], max_total_mass_kg=budget),
            ordinary=True,
        )
    yield case(
        "limits/budget-exactly-optimum-two-webs",
        "the budget is exactly what two symmetric webs need together",
        machine(single_row(), [web("a", -0.2), web("b", 0.2)], max_total_mass_kg=2.5),
        ordinary=True,
    )
    yield case(
        "limits/budget-equals-sum-of-limits",
        "budget and mass limits all bind at once",
        machine(v_twin(), [web("a", -0.4, 0.5), web("b", 0.5, 0.5)], max_total_mass_kg=1.0),
        ordinary=True,
    )
    yield case(
        "limits/budget-unlike-radii",
        "a kilogram at 0.5 m is worth ten at 0.05 m: the budget picks",
        machine(
            v_twin(), [web("a", -0.4, 3, 0.05), web("b", 0.5, 3, 0.5), web("c", 0.1, 3, 0.1)], max_total_mass_kg=2.0
        ),
        combine="max",
        ordinary=True,
    )
    yield case(
        "limits/budget-not-least-mass",
        "the first stage alone, with its budget",
        machine([throw(0, 20, [row(90, 5), row(0, 9)])], [web("a", -0.1), web("b", 0.3)], max_total_mass_kg=1.5),
        least_mass=False,
        ordinary=True,
    )
