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
    texts = {"as drawn": status_of(machine)}
    first = machine.Counterweights[0]

    def cases(name, change):
        """Change every counterweight; the change."""
        return [(counterweight, name, change(getattr(counterweight, name))) for counterweight in machine.Counterweights]

    mutations = {
        "turned by 0.1 degrees": [(first, "AskedAngle", first.AskedAngle.Value + 0.1)],
        "moved by 1 mm": [(first, "Position", first.Position.Value + 1.0)],
        "mirrored": cases("AskedAngle", lambda angle: 180.0 - angle.Value),
        "cast iron": cases("Density", lambda density: 7200.0),
        "aluminium": cases("Density", lambda density: 2700.0),
        "a smaller pin": [(document.Parameters, "B2", "=70 mm")],
    }
    for name, changes in mutations.items():
        before = [(value, attribute, value_of(value, attribute)) for value, attribute, _ in changes]
        apply(document, changes)
        texts[name] = status_of(machine)
        apply(document, before)
    texts["as before"] = status_of(machine)
    return texts


def value_of(subject, name):
    if hasattr(subject, "getContents"):
        return subject.getContents(name)
    attribute = getattr(subject, name)
    return getattr(attribute, "Value", attribute)


def apply(document, changes):
    for entry, name, value in changes:
        if hasattr(entry, "getContents"):
            entry.set(name, value)
        else:
            setattr(entry, name, value)
    document.recompute()


def status_of(machine):
    verdict = verify(machine)
    failed = [counterweight.Web for counterweight in machine.Counterweights if "Invalid" in counterweight.State]
    return {"worst": verdict.worst, "held": verdict.held, "status": machine.Status, "failed": failed}
