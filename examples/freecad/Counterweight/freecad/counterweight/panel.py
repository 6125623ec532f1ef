"""What was found, for the designer to confirm: which of the round faces are crank pins."""

import FreeCAD as App
from PySide import QtGui

from .balance import change
from .sheets import THROWS, USE
from .tables import table_of

translate = App.Qt.translate


class Pins:
    """A panel with a tick for every pin; a pin that is not one is left out of the machine."""

    def __init__(self, machine):
        self._machine = machine
        self._sheet = next(sheet for sheet in machine.Tables if sheet.Label == THROWS)
        heads, *lines = table_of(self._sheet)
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(translate("Counterweight", "Crank pins that were found"))
        layout = QtGui.QVBoxLayout(self.form)
        self.boxes = []
        for line in lines:
            said = dict(zip(heads, line))
            box = QtGui.QCheckBox(
                "{name}: z = {position_m:.4g} m, radius {crank_radius_m:.4g} m at {crank_angle_deg:.1f}°".format(**said)
            )
            box.setChecked(said[USE] == "yes")
            layout.addWidget(box)
            self.boxes.append(box)
        words = translate("Counterweight", "Rows, masses and speed are asked for in the spreadsheets.")
        layout.addWidget(QtGui.QLabel(words))

    def accept(self):
        with change(self._machine.Document, "Crank pins"):
            for number, box in enumerate(self.boxes, start=2):
                # the first column
                self._sheet.set(f"A{number}", "'yes" if box.isChecked() else "'no")
            self._machine.Document.recompute()
        return True

    def reject(self):
        return True
