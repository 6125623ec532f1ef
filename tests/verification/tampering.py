"""Answers with one thing changed, so that a claim of theirs is false."""

import copy
from collections.abc import Iterator
from typing import Any

_SHARE = 1e-6
#: figures of the residual that may be changed
_FIGURES = ("peak", "minor", "peak_x", "peak_y", "co_rotating", "counter_rotating")
_UNITS = {"force": "N", "moment": "Nm"}
#: what is smaller than this share of what it is made of is only rounding
_SEEN = 1e-7

Tampered = tuple[str, dict[str, Any]]


def tampered(answer: dict[str, Any]) -> Iterator[Tampered]:
    """Every way to falsify an answer by 1e-6 of itself, with its name."""
    yield from _masses(answer)
    yield from _residuals(answer)
    if answer["certificate"] is not None:
        for field in ("objective", "lower_bound", "objective_without_counterweights"):
            if answer["certificate"][field] and _counts(answer, answer["certificate"][field]):
                yield _changed(answer, "certificate", field)
        if answer["certificate"]["mass_lower_bound_kg"]:
            yield _changed(answer, "certificate", "mass_lower_bound_kg")
    else:
        for name, unit in _UNITS.items():
            field = f"smallest_{name}_lower_bound_{unit}"
            if answer["infeasibility"][field]:
                yield _changed(answer, "infeasibility", field)


def beyond_limits(body: dict[str, Any], answer: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Requests whose limits the counterweights of an answer break by 1e-6."""
    for k, counterweight in enumerate(answer["counterweights"]):
        if counterweight["mass_kg"] > 0:
            yield _changed_request(body, counterweight["mass_kg"] * (1 - _SHARE), "machine", "webs", k, "max_mass_kg")
            sector = {"centre_deg": counterweight["angle_deg"] + 30.0, "half_angle_deg": 30.0 * (1 - _SHARE)}
            yield _changed_request(body, sector, "machine", "webs", k, "sector")
    if answer["total_mass_kg"]:
        yield _changed_request(body, answer["total_mass_kg"] * (1 - _SHARE), "machine", "max_total_mass_kg")
    for name, unit in _UNITS.items():
        before, after = ((answer["residual"][when] or {}).get(name) for when in ("before", "after"))
        peak = after[f"peak_{unit}"] if after else 0.0
        # a ceiling counts as kept to 1e-9 of what is there without counterweights
        if answer["status"] == "optimal" and peak > 0.01 * before[f"peak_{unit}"]:
            with_objective = {**body, "objective": dict(body.get("objective", {}))}
            yield _changed_request(with_objective, peak * (1 - _SHARE), "objective", f"{name}_ceiling_{unit}")


def _masses(answer: dict[str, Any]) -> Iterator[Tampered]:
    for k, counterweight in enumerate(answer["counterweights"]):
        if counterweight["mass_kg"] > 0:
            for field in ("mass_kg", "mass_radius_kg_m"):
                yield _changed(answer, "counterweights", k, field)
            # below this the direction is the same to the last digits
            if counterweight["angle_deg"] > 1e-3:
                yield _changed(answer, "counterweights", k, "angle_deg")
    if answer["total_mass_kg"]:
        yield _changed(answer, "total_mass_kg")


def _residuals(answer: dict[str, Any]) -> Iterator[Tampered]:
    for when in ("before", "after"):
        first_order = answer["residual"][when]
        for name, unit in _UNITS.items() if first_order else ():
            size = answer["residual"]["before"][name][f"peak_{unit}"]
            for figure in _FIGURES:
                if first_order[name][f"{figure}_{unit}"] > _SEEN * size:
                    yield _changed(answer, "residual", when, name, f"{figure}_{unit}")


def _counts(answer: dict[str, Any], value: float) -> bool:
    return value > _SEEN * answer["certificate"]["objective_without_counterweights"]


def _changed(answer: dict[str, Any], *path: str | int) -> Tampered:
    variant = copy.deepcopy(answer)
    node: Any = variant
    for part in path[:-1]:
        node = node[part]
    node[path[-1]] *= 1 + _SHARE
    return "/".join(map(str, path)), variant


def _changed_request(body: dict[str, Any], value: Any, *path: str | int) -> tuple[str, dict[str, Any]]:
    variant = copy.deepcopy(body)
    node: Any = variant
    for part in path[:-1]:
        node = node[part]
    node[path[-1]] = value
    return "/".join(map(str, path)), variant
