"""Where the webs are: close together, coincident, many, far from the plane of moments, equal."""

import random
from collections.abc import Iterator

from tests.hard.cases.case import Case, case, four_webs, machine, row, single_row, throw, v_twin, web


def cases() -> Iterator[Case]:
    yield from _close()
    yield from _coincident()
    yield from _many()
    yield from _far_plane()
    yield from _ties()


def _close() -> Iterator[Case]:
    for gap in (1e-3, 1e-6, 1e-9, 1e-12):
        webs = [web("a", 0.1, 8.0), web("b", 0.1 + gap, 8.0), web("c", -0.3, 4.0)]
        yield case(
            f"webs/{gap:g}-apart",
            "two webs that the moment can hardly tell apart: the influence matrix is nearly singular",
            machine(v_twin(), webs),
            ordinary=gap >= 1e-9,
        )
        yield case(
            f"webs/only-two-{gap:g}-apart",
            "a couple would take masses of 1/gap against each other; the limits stop it",
            machine(v_twin(), [web("a", 0.1, 8.0), web("b", 0.1 + gap, 8.0)]),
            combine="max",
        )
        # larger ones would need more digits than a double holds, in arm, mass and angle
        limit = 1e12 if gap >= 1e-9 else 1e5
        yield case(
            f"webs/only-two-{gap:g}-apart-limits-{limit:g}",
            "a couple takes masses of 1/gap against each other, and they are allowed",
            machine(v_twin(), [web("a", 0.1, limit), web("b", 0.1 + gap, limit)]),
        )


def _coincident() -> Iterator[Case]:
    yield case(
        "webs/coincident-pair",
        "two webs in one plane: any split between them is optimal",
        machine(v_twin(), [web("a", 0.1, 3.0), web("b", 0.1, 3.0), web("c", -0.3, 4.0)]),
        ordinary=True,
    )
    yield case(
        "webs/all-in-one-plane",
        "eight webs in one plane act as one",
        machine(v_twin(), [web(str(k), 0.1, 1.0) for k in range(8)]),
        ordinary=True,
    )
    yield case(
        "webs/coincident-unlike-limits",
        "one plane, limits of 1e-9, 1e-3 and 1e3 kg",
        machine(v_twin(), [web("a", 0.1, 1e-9), web("b", 0.1, 1e-3), web("c", 0.1, 1e3), web("d", -0.4, 1.0)]),
        ordinary=True,
    )
    yield case(
        "webs/coincident-unlike-radii",
        "one plane, radii that differ by ten: the least mass takes the large one first, exactly",
        machine(v_twin(), [web("a", 0.1, 2.0, 0.05), web("b", 0.1, 2.0, 0.5), web("d", -0.4, 3.0)]),
        ordinary=True,
    )
    yield case(
        "webs/coincident-complementary-sectors",
        "two half-discs in one plane make a whole one",
        machine(v_twin(), [web("a", 0.1, 9.0, 0.2, (0, 90)), web("b", 0.1, 9.0, 0.2, (180, 90)), web("d", -0.4)]),
        ordinary=True,
    )
    yield case(
        "webs/coincident-opposite-sectors",
        "thin opposite sectors in one plane make a line",
        machine(v_twin(), [web("a", 0.1, 9, 0.2, (20, 1e-3)), web("b", 0.1, 9, 0.2, (200, 1e-3)), web("d", -0.4, 1)]),
    )
    yield case(
        "webs/coincident-with-budget",
        "equal webs in one plane compete for one budget",
        machine(v_twin(), [web(str(k), 0.1 * (k // 3), 2.0) for k in range(9)], max_total_mass_kg=4.0),
        ordinary=True,
    )
    yield case(
        "webs/in-the-plane-of-moments",
        "webs at the reference plane have no moment at all",
        machine(v_twin(), [web("a", 0.05, 5), web("b", 0.05, 5)], reference_plane_m=0.05),
        ordinary=True,
    )


def _many() -> Iterator[Case]:
    for count in (1, 2, 3, 5, 8, 20, 50, 100, 200):
        rng = random.Random(count)
        webs = [
            web(
                str(k),
                rng.uniform(-1, 1),
                rng.uniform(0.05, 12.0 / count),
                rng.uniform(0.1, 0.3),
                None if rng.random() < 0.5 else (rng.uniform(0, 360), rng.choice([10.0, 60.0, 90.0])),
            )
            for k in range(count)
        ]
        yield case(
            f"webs/{count}-webs",
            "the size of the program; with many webs most are either full or empty",
            machine(v_twin(), webs),
            ordinary=True,
        )
    places = [web(str(k), -1 + 0.01 * k, 0.5) for k in range(200)]
    yield case(
        "webs/200-equal-budget",
        "two hundred webs share one budget: the best planes are at the ends, the rest stays empty",
        machine(v_twin(), places, max_total_mass_kg=3.0),
        combine="max",
        peaks_unique=False,
    )
    yield case(
        "webs/200-in-20-planes",
        "ten coincident webs in each of twenty planes",
        machine(v_twin(), [web(str(k), -0.5 + 0.05 * (k % 20), 0.3) for k in range(200)]),
        ordinary=True,
    )
    yield case(
        "webs/200-within-a-micrometre",
        "two hundred webs five nanometres apart",
        machine(v_twin(), [web(str(k), 0.2 + 5e-9 * k, 0.3) for k in range(200)]),
    )


def _far_plane() -> Iterator[Case]:
    for plane in (1e3, 1e6, -1e6):
        yield case(
            f"webs/reference-plane-{plane:g}",
            "moments about a plane far away are force times distance: the couple is 1e-6 of them",
            machine(v_twin(), four_webs(), reference_plane_m=plane),
        )
        balanced = [throw(-0.3, 0.0, [row(90, 10.0)]), throw(0.3, 180.0, [row(90, 10.0)])]
        yield case(
            f"webs/reference-plane-{plane:g}-force-balanced",
            "the force cancels, so the far plane must not matter; but every web's arm is 1e6 m long",
            machine(balanced, [web("a", -0.4), web("b", 0.4)], reference_plane_m=plane),
        )
        yield case(
            f"webs/reference-plane-{plane:g}-moment-only",
            "only the moment counts, which far away is the force",
            machine(v_twin(), four_webs(), reference_plane_m=plane),
            force_weight=0.0,
            peaks_unique=False,
        )
    yield case(
        "webs/shaft-far-from-origin",
        "planes of 1e6 m plus decimetres: the arms lose six digits before anything is computed",
        machine(
            [{**fields, "position_m": 1e6 + fields["position_m"]} for fields in v_twin()],
            [{**four_web, "position_m": 1e6 + four_web["position_m"]} for four_web in four_webs()],
        ),
        ordinary=True,
    )
    yield case(
        "webs/1e-9-apart-far-plane",
        "webs a nanometre apart whose arms are 1e3 m",
        machine(v_twin(), [web("a", 0.1), web("b", 0.1 + 1e-9), web("c", -0.3)], reference_plane_m=1e3),
    )
    yield case(
        "webs/web-1e6-away",
        "one web sits 1e6 m from the machine: a microgram there outweighs the rest in moment",
        machine(v_twin(), [web("far", 1e6, 10.0), web("a", -0.3, 4.0), web("b", 0.3, 4.0)], reference_plane_m=0.0),
        moment_weight=1.0,
    )


def _ties() -> Iterator[Case]:
    yield case(
        "webs/tie-symmetric",
        "a symmetric machine with a symmetric pair: both halves are equally good",
        machine(single_row(), [web("a", -0.2), web("b", 0.2)]),
        ordinary=True,
    )
    yield case(
        "webs/tie-two-symmetric-pairs",
        "two pairs do the same at the same mass: a continuum of optima",
        machine(single_row(), [web("a", -0.2), web("b", 0.2), web("c", -0.4), web("d", 0.4)]),
        ordinary=True,
    )
    yield case(
        "webs/tie-force-only",
        "the moment does not count: every web is as good as every other",
        machine(v_twin(), [web(str(k), 0.1 * k, 1.0) for k in range(6)]),
        moment_weight=0.0,
        ordinary=True,
        peaks_unique=False,
    )
    yield case(
        "webs/tie-nearly",
        "radii that differ in the twelfth digit: a tie but for that",
        machine(v_twin(), [web(str(k), 0.1, 2.0, 0.2 * (1 + 1e-12 * k)) for k in range(4)]),
        moment_weight=0.0,
    )
    yield case(
        "webs/tie-mirror-sectors",
        "sectors mirrored about the axis of the row: the two sides tie",
        machine(single_row(), [web("a", 0.0, 9, 0.2, (240, 20)), web("b", 0.0, 9, 0.2, (300, 20))]),
        ordinary=True,
    )
