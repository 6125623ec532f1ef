"""Registers the workbench; FreeCAD runs this when it has a window."""

import os

import FreeCAD as App
import FreeCADGui as Gui

_RESOURCES = os.path.join(os.path.dirname(__file__), "resources")


class CounterweightWorkbench(Gui.Workbench):
    MenuText = App.Qt.translate("Counterweight", "Counterweight")
    ToolTip = App.Qt.translate("Counterweight", "Certified optimum counterweights, verified on the solids")
    Icon = os.path.join(_RESOURCES, "counterweight.svg")

    def Initialize(self):
        from .commands import COMMANDS

        for name, command in COMMANDS.items():
            Gui.addCommand(name, command)
        self.appendToolbar("Counterweight", list(COMMANDS))
        self.appendMenu("Counterweight", list(COMMANDS))

    def GetClassName(self):
        return "Gui::PythonWorkbench"


Gui.addPreferencePage(os.path.join(_RESOURCES, "preferences.ui"), "Counterweight")
Gui.addWorkbench(CounterweightWorkbench())
