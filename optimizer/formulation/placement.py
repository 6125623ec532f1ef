"""Counterweights that are on a machine at a radius or in a plane of their own: webs of the machine that they are on."""

from collections.abc import Iterator
from typing import Any

from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.webs import Web
from schemas.request.requests import AnalyzeRequest

_PLACE = Web(name="place", position_m=0.0, counterweight_radius_m=1.0, max_mass_kg=None)


def on_webs(request: AnalyzeRequest) -> AnalyzeRequest:
    """The request with a web for each of its counterweights, which has the radius that is said.

    What is in a plane of its own sits on a web of the crankshaft that is named after the plane. Fields may hold
    columns (n,).
    """
    if all(
        counterweight.web is not None and counterweight.radius_m is None for counterweight in request.counterweights
    ):
        return request
    radii = {
        counterweight.web: counterweight.radius_m
        for counterweight in request.counterweights
        if counterweight.web and counterweight.radius_m is not None
    }
    machine = request.machine

    values: dict[Path, Any] = {}
    for place, webs in machine.web_lists():
        for k, web in enumerate(webs):
            if web.name in radii:
                # what is at a radius of its own is not cut from the plate of its web
                own = {"counterweight_radius_m": radii[web.name], "envelope": None}
                values |= {("machine", *place, k, field): value for field, value in own.items()}
    names, placed = _names(request), []
    for n, counterweight in enumerate(request.counterweights):
        if counterweight.web is None:
            name = next(names)
            values["counterweights", n, "web"] = name
            placed.append(
                with_fields(
                    _PLACE,
                    {
                        ("name",): name,
                        ("position_m",): counterweight.position_m,
                        ("counterweight_radius_m",): counterweight.radius_m,
                    },
                )
            )
    request = with_fields(request, values)
    webs = (*request.machine.webs, *placed)
    return with_fields(request, {("machine", "webs"): webs})


def _names(request: AnalyzeRequest) -> Iterator[str]:
    """Names of planes, none of them that of a web."""
    names = {web.name for web in request.machine.every_web}
    for number, counterweight in enumerate(request.counterweights, 1):
        if counterweight.web is None:
            name = f"counterweight {number}"
            while name in names:
                name += "'"
            names.add(name)
            yield name
