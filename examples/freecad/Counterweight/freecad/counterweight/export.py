"""Files for those who make it: STEP of all solids, and the service's drawings and bill. Needs FreeCAD, no window."""

from __future__ import annotations

import json
from pathlib import Path
from zipfile import ZipFile

import Import

from .balance import verify
from .clearance import overlaps
from .service import Refused
from .sheets import Wrong


def export(machine, folder, service):
    """Write files into a folder; their paths.

    `balanced.step` holds shaft and counterweights as they are in the document. Outlines (DXF), sheets with dimensions
    (SVG), solids (STEP) and bill of material (CSV, xlsx) are those of the service.

    Raises
    ------
    Wrong
        if the solids are not those of the answer or stand in the shaft, or the service does not draw.
    """
    result = verify(machine)
    wrong = overlaps(machine) if result.held else result.words()
    if wrong:
        raise Wrong(wrong)
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
        Import.export([*machine.Shaft, *machine.Counterweights], str(target / "balanced.step"))
        package = service.drawings(_drawing_request(machine), target / "counterweights.zip")
        with ZipFile(package) as archive:
            archive.extractall(target)
    except Refused as refused:
        raise Wrong([str(refused)]) from None
    except OSError as error:
        raise Wrong([f"not exported: {error}"]) from None
    package.unlink()
    return sorted(target.iterdir())


def _drawing_request(machine):
    """The counterweights of the answer, to be drawn."""
    request, answer = json.loads(machine.Request), json.loads(machine.Answer)
    names = ("web", "mass_kg", "angle_deg")
    fitted = [{name: weight[name] for name in names} for weight in answer["counterweights"] if weight["mass_kg"] > 0]
    return {"machine": request["machine"], "counterweights": fitted}
