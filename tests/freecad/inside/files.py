"""What is exported, read back; and the service's own drawing of the same counterweights beside the solids."""

import os
from pathlib import Path

import FreeCAD as App
import Part
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance
from freecad.counterweight.export import export
from freecad.counterweight.features import shaft_moments, weight_moments
from freecad.counterweight.sheets import Wrong
from freecad.counterweight.solids import moments
from loop import machine_of


def main():
    document = App.newDocument("shaft")
    machine = machine_of("imported", document)
    service = service_at(os.environ["URL"])
    balance(machine, service)
    folder = Path(os.environ["FOLDER"]) / "out"
    texts = {"files": [path.name for path in export(machine, folder, service)]}

    weights = list(weight_moments(machine).values())
    texts["weights"] = inertia_values(sum(weights[1:], weights[0]))
    # drawn by the service, in the shaft's frame, read by FreeCAD
    texts["of the service"] = inertia_values(moments(read(folder / "counterweights.step"), 7850.0))
    shaft = list(shaft_moments(machine).values())
    texts["masses"] = [weight.mass_kg for weight in [*shaft, *weights]]
    balanced = read(folder / "balanced.step")
    texts["masses read back"] = [solid.Volume * 7850e-9 for solid in balanced.Solids]
    # in the document's coordinates, as the shaft was imported
    drawn = [counterweight.Shape for counterweight in [*machine.Shaft, *machine.Counterweights]]
    texts["centre apart mm"] = (centre(drawn) - centre([balanced])).Length

    machine.Counterweights[0].AskedAngle = machine.Counterweights[0].AskedAngle.Value + 1.0
    document.recompute()
    try:
        export(machine, folder / "wrong", service)
    except Wrong as wrong:
        texts["refused"] = wrong.lines
    texts["nothing written"] = not (folder / "wrong").exists()
    return texts


def read(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def inertia_values(counterweight):
    parts = counterweight.static_kg_m, counterweight.axial_kg_m2
    return [counterweight.mass_kg, *(component for part in parts for component in (part.real, part.imag))]


def centre(shapes):
    solids = [solid for shape in shapes for solid in shape.Solids]
    total = sum(solid.Volume for solid in solids)
    at = App.Vector()
    for solid in solids:
        at += solid.CenterOfMass * (solid.Volume / total)
    return at
