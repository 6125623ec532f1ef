"""Connecting rods hardly longer than the crank, infinite ones, heavy ones; rows beside their throw."""

from collections.abc import Iterator

from tests.hard.cases.case import Case, case, machine, row, throw, web


def cases() -> Iterator[Case]:
    for name, length in (("1.0000001-cranks", 0.1 * 1.0000001), ("infinite", None), ("1e9", 1e9)):
        for rotation in ("ccw", "cw"):
            yield case(
                f"rods/{name}-{rotation}",
                "the first order does not depend on the rod, however much the higher orders do",
                machine(_throws({"length_m": length}), _webs(), rotation=rotation),
                ordinary=True,
            )
        yield case(
            f"rods/{name}-heavy",
            "nearly all of the mass is in the rod, shared between crosshead and pin",
            machine(_throws({"length_m": length, "mass_kg": 1e6, "reciprocating_share": 1e-9}), _webs(1e7)),
        )
    for share in (0.0, 1.0):
        yield case(
            f"rods/share-{share:g}",
            "the rod turns as a whole, or moves along as a whole",
            machine(_throws({"length_m": 0.5, "mass_kg": 7.0, "reciprocating_share": share}), _webs()),
            combine="max",
            ordinary=True,
            peaks_unique=False,  # the smaller of the two peaks is free
        )
    for offset in (1e-9, 10.0):
        throws = _throws({"length_m": 0.5, "mass_kg": 7.0})
        for crank in throws:
            crank["rows"][0]["offset_m"] = offset
        yield case(
            f"rods/offset-{offset:g}",
            "a row beside its throw: its big end turns in the row's plane, not in that of the throw",
            machine(throws, _webs(), rotation="cw"),
            ordinary=True,
        )


def _throws(rod: dict) -> list[dict]:
    return [
        throw(-0.2, 0, [row(90, 8.0, connecting_rod=dict(rod)), row(10, 5.0, connecting_rod=dict(rod))], rotating=2),
        throw(0.3, 110, [row(90, 6.0, connecting_rod=dict(rod))]),
    ]


def _webs(mass: float = 100.0) -> list[dict]:
    return [web("a", -0.3, mass), web("b", 0.1, 0.3 * mass, 0.2, (250, 30)), web("c", 0.4, mass)]
