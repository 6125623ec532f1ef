"""A shaft in, a balanced shaft out, without a window: STEP or FCStd with a description of what no face shows.

Settings are environment variables, as FreeCAD takes no arguments of others:

    COUNTERWEIGHT_SHAFT    shaft.step, or a document of FreeCAD, all of whose solids are the shaft
    COUNTERWEIGHT_MACHINE  machine.json: a request of /v1/optimize without what the faces show; throws and webs stand in
                           their order along the shaft, with density_kg_m3 beside them
    COUNTERWEIGHT_FOLDER   where balanced.FCStd, balanced.step, drawings and bill go
    COUNTERWEIGHT_URL      where the service is; COUNTERWEIGHT_KEY its key
    COUNTERWEIGHT_FORCE    1 to go on where the shaft cannot be one; what is printed says so
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import FreeCAD as App
import Part

from .asking import forced, service_at
from .balance import balance, read_shaft, shaft_words
from .clearance import clearance
from .export import export
from .preferences import url
from .sheets import Wrong
from .solids import STEEL_KG_M3


def run():
    """Do it all; the exit code."""
    try:
        for line in _balanced(*(_setting(name) for name in ("SHAFT", "MACHINE", "FOLDER"))):
            print(line)
    except Wrong as wrong:
        print("\n".join(wrong.lines))
        return 1
    return 0


def _setting(name):
    value = os.environ.get(f"COUNTERWEIGHT_{name}")
    if not value:
        raise Wrong([f"COUNTERWEIGHT_{name} is not set"])
    return Path(value)


def _balanced(shaft, machine, folder):
    try:
        description = json.loads(machine.read_text())
        density = float(description.pop("density_kg_m3", STEEL_KG_M3))
    except (OSError, ValueError, TypeError, AttributeError) as error:
        raise Wrong([f"{machine}: {error}"]) from None
    document = _opened(shaft)
    bodies = [body for body in document.RootObjects if getattr(body, "Shape", None) is not None and body.Shape.Solids]
    service = service_at(os.environ.get("COUNTERWEIGHT_URL") or url())
    force = forced()
    model = read_shaft(document, bodies, service, [density] * len(bodies), description=description, force=force)
    yield from (f"to look at: {line}" for line in model.Doubts)
    yield shaft_words(model)
    yield from balance(model, service, force).words()
    in_the_way = clearance(model)
    if in_the_way:
        raise Wrong(in_the_way)
    yield "nothing of the shaft is in the way of the counterweights"
    for path in export(model, folder, service):
        yield str(path)
    document.saveAs(str(folder / "balanced.FCStd"))


def _opened(shaft):
    if not shaft.exists():
        raise Wrong([f"there is no {shaft}"])
    try:
        if shaft.suffix.lower() == ".fcstd":
            return App.openDocument(str(shaft))
        document = App.newDocument("balanced")
        Part.insert(str(shaft), document.Name)
    # whatever a reader raises on what it cannot read
    except Exception as error:
        raise Wrong([f"{shaft} cannot be read: {error}"]) from None
    document.recompute()
    return document
