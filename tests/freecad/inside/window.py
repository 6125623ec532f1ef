"""The workbench in a window: its commands run as from the menu, and a picture of what is seen."""

import os
import time

import FreeCAD as App
import FreeCADGui as Gui
import shafts
from loop import complete
from PySide import QtCore, QtGui

#: generous: the machine is busy
_WITHIN_S = 300.0


def main():
    Gui.activateWorkbench("CounterweightWorkbench")
    App.ParamGet("User parameter:BaseApp/Preferences/Mod/Counterweight").SetString("Url", os.environ["URL"])
    document = App.newDocument("shaft")
    bodies = shafts.part_design(document)
    texts = {
        "workbench": Gui.activeWorkbench().name(),
        "commands": sorted(name for name in Gui.listCommands() if name.startswith("Counterweight_")),
    }
    for body in bodies:
        Gui.Selection.addSelection(body)
    Gui.runCommand("Counterweight_Read")
    wait(lambda: document.getObject("Machine") is not None)
    machine = document.getObject("Machine")
    boxes = Gui.getMainWindow().findChildren(QtGui.QCheckBox)
    texts["pins"] = [box.text() for box in boxes if "radius" in box.text()]
    texts["ticked"] = [box.isChecked() for box in boxes if "radius" in box.text()]
    texts["shaft"] = labels()
    grab("shaft.png")
    Gui.runCommand("Counterweight_Balance")
    texts["without a confirmation"] = report()
    press("OK")
    texts["confirmed"] = machine.Confirmed
    Gui.runCommand("Counterweight_Balance")
    wait(lambda: "this field is required" in report())
    texts["without a speed"] = report()
    complete(machine)
    document.recompute()
    Gui.runCommand("Counterweight_Balance")
    wait(lambda: machine.Answer)
    Gui.runCommand("Counterweight_Verify")
    texts["verdict"] = labels()
    icons = (Gui.Command.get(name).getInfo()["pixmap"] for name in texts["commands"])
    texts["icons"] = sorted(os.path.basename(icon) for icon in icons)
    Gui.runCommand("Counterweight_Clearance")
    texts["report"] = report()
    texts["status"] = machine.Status
    for document_object in document.Objects:
        if document_object.TypeId in ("App::Origin", "Spreadsheet::Sheet"):
            document_object.ViewObject.Visibility = False
    Gui.Selection.clearSelection()
    view = Gui.activeDocument().activeView()
    view.viewIsometric()
    view.fitAll()
    wait(lambda: True)
    view.saveImage(os.path.join(os.environ["FOLDER"], "view.png"), 900, 700, "White")
    grab("window.png")
    return texts


def labels():
    """What the open panel says."""
    wait(lambda: True)
    return [label.text() for label in Gui.getMainWindow().findChildren(QtGui.QLabel) if label.wordWrap()]


def press(text):
    """A button of the open panel."""
    buttons = Gui.getMainWindow().findChildren(QtGui.QPushButton)
    next(button for button in buttons if button.text().strip("&") == text).click()
    wait(lambda: True)


def grab(name):
    Gui.getMainWindow().resize(1400, 900)
    wait(lambda: True)
    Gui.getMainWindow().grab().save(os.path.join(os.environ["FOLDER"], name))


def report():
    """What stands in the report view."""
    wait(lambda: True)
    views = Gui.getMainWindow().findChildren(QtGui.QTextEdit)
    return "\n".join(view.toPlainText() for view in views)


def wait(until):
    """Let the window work until something has happened, and a little longer."""
    deadline = time.monotonic() + _WITHIN_S
    while not until():
        if time.monotonic() > deadline:
            raise TimeoutError(report())
        QtCore.QCoreApplication.processEvents(QtCore.QEventLoop.AllEvents, 50)
        # else it looks again and again while the service, on the same cores, computes
        time.sleep(0.02)
    for _ in range(5):
        QtCore.QCoreApplication.processEvents(QtCore.QEventLoop.AllEvents, 50)
