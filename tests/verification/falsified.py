"""Answers with one leaf falsified: every number of an answer, in every way, and what the checker makes of it."""

import copy
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

from service.verification import checker

Path = tuple[str | int, ...]
Outcome = Literal["caught", "named", "rounding", "missed"]
#: share of the largest figure of the same unit below which one is what rounding leaves
_DUST = 1e-9
#: m: with which the forces make a moment that others cancel
_ARM = 0.1
WAYS = ("x1.001", "x0.999", "x1000", "0", "sign", "swap", "deletion")


class Falsified(NamedTuple):
    """An answer with one thing changed."""

    path: Path
    way: str
    answer: Any
    whole: Any  # as it was


def numbers(answer: Any, path: Path = ()) -> Iterator[Path]:
    """Places of all numbers; of long lists the first three."""
    if isinstance(answer, dict):
        for name, value in answer.items():
            yield from numbers(value, (*path, name))
    elif isinstance(answer, list):
        for k, value in enumerate(answer[:3] if len(answer) > 12 else answer):
            yield from numbers(value, (*path, k))
    elif isinstance(answer, int | float) and not isinstance(answer, bool):
        yield path


def falsified(answer: Any, path: Path, number: Any) -> Iterator[Falsified]:
    """Every way to falsify one number; ``other`` is the one that it is swapped with."""
    leaf = at(answer, path)
    ways = {"x1.001": leaf * 1.001, "x0.999": leaf * 0.999, "x1000": leaf * 1000.0, "0": 0.0, "sign": -leaf}
    for way, wrong in ways.items():
        # 180 degrees are -180 degrees
        if wrong != leaf and not (way == "sign" and str(path[-1]) == "phase_deg" and abs(leaf) == 180.0):
            yield Falsified(path, way, replaced(answer, path, wrong), answer)
    if number is not None and at(answer, number) != leaf:
        swapped = replaced(replaced(answer, path, at(answer, number)), number, leaf)
        yield Falsified(path, "swap", swapped, answer)
    yield Falsified(path, "deletion", deleted(answer, path), answer)


def at(answer: Any, path: Path) -> Any:
    """What stands at a place."""
    for part in path:
        answer = answer[part]
    return answer


def replaced(answer: Any, path: Path, value: Any) -> Any:
    """A copy with another value at a place; the rest is shared."""
    if not path:
        return value
    variant = copy.copy(answer)
    variant[path[0]] = replaced(answer[path[0]], path[1:], value)
    return variant


def deleted(answer: Any, path: Path) -> Any:
    """A copy without what stands at a place."""
    variant = copy.copy(answer)
    if len(path) == 1:
        del variant[path[0]]
    else:
        variant[path[0]] = deleted(answer[path[0]], path[1:])
    return variant


def outcome(request: Any, forgery: Falsified, silent: tuple[str, ...]) -> Outcome:
    """What becomes of it: broken or refused, its place named as one that is not looked at, or neither.

    Parameters
    ----------
    silent : names of what claims nothing, or is evidence of what is claimed elsewhere.
    """
    try:
        verdict = checker().verify(request, forgery.answer)
    except checker().Unreadable:
        return "caught"
    if verdict["verdict"] == "broken":
        return "caught"
    pointer = "/answer" + "".join(f"/{'*' if isinstance(part, int) else escaped(part)}" for part in forgery.path)
    names = [
        *verdict["not_covered"],
        *(claim["where"] for claim in verdict["claims"] if claim["verdict"] == "not covered"),
    ]
    if any(pointer == name or pointer.startswith(f"{name}/") for name in names):
        return "named"
    if any(part in silent for part in forgery.path):
        return "named"
    return "rounding" if _dust(forgery.whole, forgery.path) else "missed"


def _dust(answer: Any, path: Path) -> bool:
    """Whether a number is what rounding leaves of the forces or moments of the answer, or the direction of that.

    So it is beside what the same object and those around it hold: of a phasor and of an ellipse, both orders, before
    and after.
    """
    here = at(answer, path[:-1])
    if path[0] == "stages":
        return _size(here, path) <= _DUST * max(stage["value"] for stage in answer["stages"])
    if path[0] not in ("residual", "orders", "foundation_loads") and "first_order" not in path:
        return False
    kind = "_Nm" if "moment" in path or any(str(part).startswith("couple") for part in path) else "_N"
    sizes_of = {"_N": 1.0 if kind == "_N" else _ARM, "_Nm": 1.0 if kind == "_Nm" else 0.0}
    figures = [
        (number, sizes_of.get("_" + str(number[-1]).rpartition("_")[2], 0.0))
        for number in numbers(answer["residual"], ("residual",))
    ]
    largest = max(arm * abs(at(answer, texts)) for texts, arm in figures)
    leaf = at(answer, path)
    if str(path[-1]).endswith("_deg"):
        # along what is smallest of it: one of both phasors, or the phasor itself
        lengths = ("co_", "counter_", "magnitude", "amplitude")
        sizes = [abs(length) for name, length in here.items() if name.startswith(lengths)]
        return min(sizes) <= _DUST * largest
    values = [number for name, number in here.items() if name.endswith(kind) and name != path[-1]]
    return abs(leaf) <= _DUST * largest or any(abs(leaf - number) <= _DUST * largest for number in values)


def _size(here: Any, path: Path) -> float:
    """Of a figure, or of that of which it tells the direction."""
    size: float = here["peak"] if path[-1] == "direction_deg" else here[path[-1]]
    return abs(size)


def escaped(part: str) -> str:
    """A part of a JSON pointer."""
    return part.replace("~", "~0").replace("/", "~1")


def silent() -> tuple[str, ...]:
    """Parts of an answer that claim nothing by themselves."""
    from sys import modules

    checker()
    return (*modules["verify_leaves"].REMARKS, "multipliers", "nominal_multipliers", "implied_max_mass_kg")
