"""Weights: one direction hardly or not at all, force against moment over twenty powers of ten."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, four_webs, machine, single_row, v_twin, web


def cases() -> Iterator[Case]:
    for x, y in ((1e-8, 1), (1, 1e-8), (0, 1), (1, 0), (1e-3, 1), (1, 1.0000001), (1e-8, 1e-8), (1e8, 1)):
        for combine in ("sum", "max"):
            yield case(
                f"weights/directions-{x}-{y}-{combine}",
                "the norm terms of a weighted peak are nearly, or exactly, each other's mirror images",
                machine(v_twin(), four_webs(), rotation="ccw" if combine == "sum" else "cw"),
                combine=combine,
                direction_weights={"x": x, "y": y},
                ordinary=combine == "sum",
                peaks_unique=not (x == 0 or y == 0),
            )
    for x, y in ((0, 1), (1, 0), (1e-8, 1)):
        yield case(
            f"weights/single-row-directions-{x:g}-{y:g}",
            "along its axis the row is cancelled completely; across, anything or next to nothing is allowed",
            machine(single_row(), [web("a", 0.0)]),
            direction_weights={"x": x, "y": y},
            ordinary=x in (0, 1),
        )
    for power in (-20, -12, -8, 8, 12, 20):
        for combine in ("sum", "max"):
            yield case(
                f"weights/moment-1e{power}-{combine}",
                "one peak is nothing beside the other, but it is still asked for",
                machine(v_twin(), four_webs()),
                moment_weight=10.0**power,
                combine=combine,
                peaks_unique=False,  # the peak that hardly counts is free within what optima may differ
            )
    for name, weight in (("force", {"moment_weight": 0.0}), ("moment", {"force_weight": 0.0, "moment_weight": 1.0})):
        yield case(
            f"weights/{name}-alone",
            "one response has no weight at all",
            machine(v_twin(), four_webs(), rotation="cw"),
            ordinary=True,
            peaks_unique=False,
            **weight,
        )
    for size in (1e-30, 1e30):
        yield case(
            f"weights/both-{size:g}",
            "both weights far from one: the objective has no natural size",
            machine(v_twin(), four_webs()),
            force_weight=size,
            moment_weight=size,
            ordinary=True,
        )
    yield case(
        "weights/lopsided-both-ways",
        "directions 1e-8 to 1 and moment weight 1e8: four terms over sixteen powers of ten",
        machine(v_twin(), four_webs()),
        direction_weights={"x": 1e-8, "y": 1},
        moment_weight=1e8,
        # the force counts for 1e-8 of the objective, less than optima may differ by
        peaks_unique=False,
    )
    yield case(
        "weights/max-tie",
        "a weight at which both peaks are equal without counterweights, and the webs serve one of them only",
        machine(single_row(), [web("a", 0.0, 1.0)], reference_plane_m=-1.0),
        combine="max",
        moment_weight=1.0,
        ordinary=True,
    )
