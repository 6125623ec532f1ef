"""Wrong drawings and changes after the answer: what the check says of each."""

import os

import FreeCAD as App
from freecad.counterweight.asking import service_at
from freecad.counterweight.balance import balance, verify
from loop import machine_of


def main():
    document = App.newDocument("shaft")
    machine = machine_of("native", document)
    balance(machine, service_at(os.environ["URL"]))
    found = {"as drawn": told(machine)}
    first = machine.Counterweights[0]

    def each(name, change):
        """Change every counterweight; the change."""
        return [(one, name, change(getattr(one, name))) for one in machine.Counterweights]

    mutations = {
        "turned by 0.1 degrees": [(first, "AskedAngle", first.AskedAngle.Value + 0.1)],
        "moved by 1 mm": [(first, "Position", first.Position.Value + 1.0)],
        "mirrored": each("AskedAngle", lambda angle: 180.0 - angle.Value),
        "cast iron": each("Density", lambda density: 7200.0),
        "aluminium": each("Density", lambda density: 2700.0),
        "a smaller pin": [(document.Parameters, "B2", "=70 mm")],
    }
    for name, changes in mutations.items():
        before = [(one, what, value_of(one, what)) for one, what, _ in changes]
        apply(document, changes)
        found[name] = told(machine)
        apply(document, before)
    found["as before"] = told(machine)
    return found


def value_of(one, name):
    if hasattr(one, "getContents"):
        return one.getContents(name)
    value = getattr(one, name)
    return getattr(value, "Value", value)


def apply(document, changes):
    for one, name, value in changes:
        if hasattr(one, "getContents"):
            one.set(name, value)
        else:
            setattr(one, name, value)
    document.recompute()


def told(machine):
    verdict = verify(machine)
    failed = [one.Web for one in machine.Counterweights if "Invalid" in one.State]
    return {"worst": verdict.worst, "held": verdict.held, "status": machine.Status, "failed": failed}
