"""The closed loop of one of the three shafts: read, ask, draw, verify."""

import os
import time

import FreeCAD as App
import shafts
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance, read_shaft
from freecad.counterweight.tables import table_of, write

ROWS = ((277.79, 0.0), (251.72, 180.0))


def machine_of(kind, document):
    """A shaft that was read, with tables that were completed."""
    machine = read_shaft(document, getattr(shafts, kind)(document), service_at(os.environ["URL"]))
    complete(machine)
    document.recompute()
    return machine


def complete(machine, speed_rpm=500.0, reach_m=0.36, opening_deg=80.0):
    """Fill in what no face shows."""
    sheets = {sheet.Label: sheet for sheet in machine.Tables}
    write(sheets["machine"], [[], [], [None, speed_rpm], ["objective.combine", "max"]])
    names = [line[1] for line in table_of(sheets["throws"])[1:] if line[0] == "yes"]
    for number, (name, (mass, axis)) in enumerate(zip(names, ROWS, strict=True), start=2):
        row = [name, f"row {name}", axis, mass, 0.7, 86.025, 0.3]
        write(sheets["rows"], [*([[]] * (number - 1)), row])
    heads, *webs = table_of(sheets["webs"])
    for line in webs:
        line[heads.index("envelope.outer_radius_m")] = reach_m
        line[heads.index("envelope.max_half_angle_deg")] = opening_deg
    write(sheets["webs"], [heads, *webs])


def main():
    begun = time.process_time()
    document = App.newDocument("shaft")
    machine = machine_of(os.environ["SHAFT"], document)
    tables = {sheet.Label: table_of(sheet) for sheet in machine.Tables}
    verdict = balance(machine, service_at(os.environ["URL"]))
    document.saveAs(os.path.join(os.environ["FOLDER"], "balanced.FCStd"))
    return {
        "tables": tables,
        "doubts": list(machine.Doubts),
        "worst": verdict.worst,
        "held": verdict.held,
        "words": verdict.words(),
        "status": machine.Status,
        "request": machine.Request,
        "answer": machine.Answer,
        "solids": {
            counterweight.Web: {
                "mass_kg": counterweight.Mass,
                "unbalance_kg_m": counterweight.Unbalance,
                "half_angle_deg": counterweight.HalfAngle.Value,
            }
            for counterweight in machine.Counterweights
        },
        "seconds": time.process_time() - begun,
    }
