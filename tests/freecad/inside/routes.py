"""The same shaft through the route and through the workbench's own integrals."""

import os

import FreeCAD as App
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import selection_of
from freecad.counterweight.features import shaft_moments
from freecad.counterweight.shaft import ask_shaft
from loop import machine_of


def main():
    fields = {}
    for kind in ("native", "imported"):
        document = App.newDocument("shaft")
        machine = machine_of(kind, document)
        moments = list(shaft_moments(machine).values())
        total = sum(moments[1:], moments[0])
        service = service_at(os.environ["URL"])
        answer = ask_shaft(service, selection_of(machine.Shaft, None, machine.Frame).question)
        # without the frame it finds the same one
        alone = ask_shaft(service, selection_of(machine.Shaft).question)
        fields[kind] = {
            "own": [total.mass_kg, total.static_kg_m.real, total.static_kg_m.imag],
            "own couple": [total.axial_kg_m2.real, total.axial_kg_m2.imag],
            "answer": answer,
            "alone": alone,
        }
        App.closeDocument(document.Name)
    return fields
