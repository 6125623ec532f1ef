"""What was found, for the designer to confirm, and what came of it: panels beside the drawing."""

from html import escape

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

from .balance import change, shaft_words
from .sheets import THROWS, USE, Wrong
from .tables import table_of

translate = App.Qt.translate


def show(panel):
    """A panel, in place of the one that is open."""
    Gui.Control.closeDialog()
    Gui.Control.showDialog(panel)


class Shaft:
    """Mass and sizes of the shaft, to be confirmed, with a tick for every pin and with what should be looked at."""

    def __init__(self, machine):
        self._machine = machine
        self._sheet = next(sheet for sheet in machine.Tables if sheet.Label == THROWS)
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(translate("Counterweight", "Is this the shaft?"))
        self._layout = QtGui.QVBoxLayout(self.form)
        try:
            self._label(f"<b>{escape(shaft_words(machine))}</b>")
        except Wrong as wrong:
            self._label("<br>".join(map(escape, wrong.lines)))
        self._label(translate("Counterweight", "Lengths are those of the document. OK confirms mass and sizes."))
        for doubt in machine.Doubts:
            self._label(escape(doubt))
        heads, *lines = table_of(self._sheet)
        self.boxes = []
        for line in lines:
            row = dict(zip(heads, line))
            box = QtGui.QCheckBox(
                "{name}: z = {position_m:.4g} m, radius {crank_radius_m:.4g} m at {crank_angle_deg:.1f}°".format(**row)
            )
            box.setChecked(row[USE] == "yes")
            self._layout.addWidget(box)
            self.boxes.append(box)
        self._label(translate("Counterweight", "Rows, masses and speed are asked for in the spreadsheets."))

    def _label(self, text):
        label = QtGui.QLabel(text)
        label.setWordWrap(True)
        self._layout.addWidget(label)

    def accept(self):
        with change(self._machine.Document, "Confirm shaft"):
            for number, box in enumerate(self.boxes, start=2):
                # the first column
                self._sheet.set(f"A{number}", "'yes" if box.isChecked() else "'no")
            self._machine.Document.recompute()
            try:
                self._machine.Confirmed = shaft_words(self._machine)
            except Wrong as wrong:
                for line in wrong.lines:
                    App.Console.PrintError(f"Counterweight: {line}\n")
        return True

    def reject(self):
        return True


class Result:
    """The verdict in a bold line, and what stands behind it."""

    def __init__(self, words):
        headline, *details = words
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(translate("Counterweight", "Verdict"))
        layout = QtGui.QVBoxLayout(self.form)
        for text in (f"<b>{escape(headline)}</b>", "<br>".join(map(escape, details))):
            label = QtGui.QLabel(text)
            label.setWordWrap(True)
            layout.addWidget(label)
