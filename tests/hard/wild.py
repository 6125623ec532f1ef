"""Random wild requests for the searches: every size, limit and weight over many powers of ten."""

import copy
from typing import Any

from hypothesis import strategies as st

from tests.hard.cases.case import Body, machine, row, throw, web

_ANGLES = st.one_of(st.floats(-360, 360, allow_subnormal=False), st.sampled_from([0.0, 60.0, 90.0, 120.0, 180.0]))
_HALF_ANGLES = st.sampled_from([1e-6, 1e-3, 1.0, 30.0, 60.0, 89.999999, 90.0])


def _size(low: int, high: int) -> st.SearchStrategy[float]:
    """A number between 10^low and 10^high, of any mantissa."""
    return st.builds(lambda power, mantissa: mantissa * 10.0**power, st.integers(low, high - 1), st.floats(1.0, 10.0))


@st.composite
def requests(draw: st.DrawFn, ceilings: bool = True, max_webs: int = 5) -> Body:
    """Any request of the battery's kinds, all at once."""
    span = draw(st.sampled_from([1e-3, 1.0, 1.0, 1.0, 1e3]))
    places = st.one_of(st.floats(-1, 1, allow_subnormal=False), st.sampled_from([0.0, 0.1, 0.1 + 1e-9, -0.5])).map(
        lambda z: z * span
    )
    masses = st.one_of(_size(-9, 6), _size(0, 2), _size(0, 2), st.just(0.0))
    throws = [
        throw(
            draw(places),
            draw(_ANGLES),
            [row(draw(_ANGLES), draw(masses)) for _ in range(draw(st.integers(0, 2)))],
            radius=draw(st.one_of(st.just(0.1), _size(-6, 1))),
            rotating=draw(masses),
        )
        for _ in range(draw(st.integers(1, 3)))
    ]
    limits = st.one_of(_size(-12, 12), _size(-1, 2), _size(-1, 2), st.just(0.0))
    webs = [
        web(
            str(k),
            draw(places),
            draw(limits),
            draw(st.one_of(st.just(0.2), _size(-3, 1))),
            draw(st.one_of(st.none(), st.tuples(_ANGLES, _HALF_ANGLES))),
        )
        for k in range(draw(st.integers(1, max_webs)))
    ]
    body: Body = {
        "machine": machine(
            throws,
            webs,
            omega=draw(_size(-2, 5)),
            rotation=draw(st.sampled_from(["ccw", "cw"])),
            reference_plane_m=draw(st.one_of(st.none(), st.just(0.3 * span), st.just(1e3 * span))),
            max_total_mass_kg=draw(st.one_of(st.none(), st.none(), limits)),
        ),
        "objective": draw(_objectives()),
    }
    if ceilings and draw(st.booleans()):
        body["objective"][draw(st.sampled_from(["force_ceiling_N", "moment_ceiling_Nm"]))] = draw(_size(-3, 9))
    return body


def _objectives() -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries(
        {
            "combine": st.sampled_from(["sum", "max"]),
            "direction_weights": st.sampled_from(
                [{"x": 1, "y": 1}, {"x": 1, "y": 1}, {"x": 1e-8, "y": 1}, {"x": 0, "y": 1}, {"x": 1, "y": 0.3}]
            ),
            "moment_weight": st.one_of(st.none(), st.none(), _size(-8, 8)),
        }
    )


def in_other_units(body: Body, mass: float, length: float) -> Body:
    """The same machine with masses and lengths counted in other units; forces in mass x length, at the same speed."""
    changed = copy.deepcopy(body)
    data, objective = changed["machine"], changed["objective"]

    def scale(place: dict[str, Any], name: str, factor: float) -> None:
        if place.get(name) is not None:
            place[name] *= factor

    scale(data, "reference_plane_m", length)
    scale(data, "max_total_mass_kg", mass)
    for crank in data["throws"]:
        for name in ("position_m", "crank_radius_m"):
            scale(crank, name, length)
        scale(crank, "rotating_mass_kg", mass)
        for line in crank["rows"]:
            scale(line, "reciprocating_mass_kg", mass)
    for plane in data["webs"]:
        for name in ("position_m", "counterweight_radius_m"):
            scale(plane, name, length)
        scale(plane, "max_mass_kg", mass)
    places = [plane["position_m"] for plane in (*data["throws"], *data["webs"])]
    if objective.get("moment_weight") is None and max(places) == min(places):
        # without a span it is 1 of the metres that are no longer counted in
        objective["moment_weight"] = 1.0
    scale(objective, "moment_weight", 1.0 / length)
    scale(objective, "force_ceiling_N", mass * length)
    scale(objective, "moment_ceiling_Nm", mass * length**2)
    return changed
