"""Counterweights that are on a machine at a radius or in a plane of their own: webs of the machine that they are on."""

from collections.abc import Iterator

from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.webs import Web
from schemas.request.requests import AnalyzeRequest

_PLACE = Web(name="place", position_m=0.0, counterweight_radius_m=1.0, max_mass_kg=None)


def on_webs(request: AnalyzeRequest) -> AnalyzeRequest:
    """The request with a web for each of its counterweights, which has the radius that is said.

    What is in a plane of its own sits on a web of the crankshaft that is named after the plane. Fields may hold
    columns (n,).
    """
    if all(one.web is not None and one.radius_m is None for one in request.counterweights):
        return request
    radii = {one.web: one.radius_m for one in request.counterweights if one.web and one.radius_m is not None}
    machine = request.machine

    def own(webs: tuple[Web, ...]) -> tuple[Web, ...]:
        """Webs at the radius of what they carry, which then is not cut from their plate."""
        return tuple(
            web.model_copy(update={"counterweight_radius_m": radii[web.name], "envelope": None})
            if web.name in radii
            else web
            for web in webs
        )

    names, placed, fitted = _names(request), list(own(machine.webs)), []
    for one in request.counterweights:
        if one.web is None:
            update = {"name": next(names), "position_m": one.position_m, "counterweight_radius_m": one.radius_m}
            placed.append(_PLACE.model_copy(update=update))
            one = one.model_copy(update={"web": update["name"]})
        fitted.append(one)
    changes: dict[str, object] = {"webs": tuple(placed)}
    if isinstance(machine, ReciprocatingMachine):
        changes["balance_shafts"] = tuple(
            shaft.model_copy(update={"webs": own(shaft.webs)}) for shaft in machine.balance_shafts
        )
    return request.model_copy(update={"machine": machine.model_copy(update=changes), "counterweights": tuple(fitted)})


def _names(request: AnalyzeRequest) -> Iterator[str]:
    """Names of planes, none of them that of a web."""
    machine = request.machine
    shafts = machine.balance_shafts if isinstance(machine, ReciprocatingMachine) else ()
    taken = {web.name for place in (machine, *shafts) for web in place.webs}
    for number, one in enumerate(request.counterweights, 1):
        if one.web is None:
            name = f"counterweight {number}"
            while name in taken:
                name += "'"
            taken.add(name)
            yield name
