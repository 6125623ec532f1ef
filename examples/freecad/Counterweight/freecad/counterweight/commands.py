"""What the menu does: every command calls a function that needs no window, and says in the report view what came of it.

Only the question to the service runs beside the window, in a thread of its own; documents are changed in the window's.
"""

import os

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from .asking import KEY, ask, forced, service_at
from .balance import draw, drawn_from, question_of, selection_of, shaft_words, verify
from .clearance import clearance, overlaps
from .export import export
from .panel import Result, Shaft, show
from .preferences import url
from .shaft import ask_shaft
from .sheets import Wrong

_ICONS = os.path.join(os.path.dirname(__file__), "resources")
translate = App.Qt.translate


class _Command:
    """A menu entry; what is wrong is said in the report view, line by line."""

    def __init__(self, icon, text, tip, does, on_machine=True):
        self._icon = os.path.join(_ICONS, f"{icon}.svg")
        self._text, self._tip, self._does, self._on_machine = text, tip, does, on_machine

    def GetResources(self):
        text, tip = translate("Counterweight", self._text), translate("Counterweight", self._tip)
        return {"MenuText": text, "ToolTip": tip, "Pixmap": self._icon}

    def IsActive(self):
        return App.ActiveDocument is not None

    def Activated(self):
        try:
            self._does(_machine()) if self._on_machine else self._does()
        except Wrong as wrong:
            complain(wrong)


def complain(wrong):
    """In the report view."""
    for line in wrong.lines:
        App.Console.PrintError(f"Counterweight: {line}\n")


def tell(lines):
    for line in lines:
        App.Console.PrintMessage(f"Counterweight: {line}\n")


def _machine():
    """The machine that is selected, or the only one."""
    selection = [machine for machine in Gui.Selection.getSelection() if hasattr(machine, "Shaft")]
    every = selection or [machine for machine in App.ActiveDocument.Objects if hasattr(machine, "Shaft")]
    if len(every) != 1:
        raise Wrong([f"{len(every)} machines: select one, or read the shaft first"])
    return every[0]


def _read():
    bodies = [body for body in Gui.Selection.getSelection() if getattr(body, "Shape", None) and body.Shape.Faces]
    document, selected, service = App.ActiveDocument.Name, selection_of(bodies), _service()

    def on_answer(answer):
        machine = drawn_from(App.getDocument(document), selected, answer, force=forced())
        show(Shaft(machine))

    _beside(lambda: ask_shaft(service, selected.question), on_answer)


# ---- asking


class _Asking(QtCore.QThread):
    """One question to the service, beside the window."""

    def __init__(self, question):
        super().__init__()
        self._question = question
        self.answer = self.wrong = None

    def run(self):
        try:
            self.answer = self._question()
        except Wrong as wrong:
            self.wrong = wrong


#: threads that run, so that nothing throws them away
_RUNNING = set()


def _beside(question, then):
    """Ask in a thread of its own, and go on with the answer in the window's."""
    asking = _Asking(question)

    def on_finish():
        _RUNNING.discard(asking)
        try:
            if asking.wrong is not None:
                raise asking.wrong
            then(asking.answer)
        except Wrong as wrong:
            complain(wrong)
        except (NameError, AttributeError, ReferenceError):
            # closed or deleted while the service was asked
            complain(Wrong(["the document or the machine is gone: nothing was drawn"]))

    asking.finished.connect(on_finish)
    _RUNNING.add(asking)
    asking.start()


def _balance(machine):
    words = shaft_words(machine)
    if machine.Confirmed != words:
        show(Shaft(machine))
        raise Wrong([f"confirm first: {words}"])
    question, service = question_of(machine, forced()), _service()
    document, name = machine.Document.Name, machine.Name

    def on_answer(answer):
        machine = App.getDocument(document).getObject(name)
        _result(draw(machine, question, answer).words())
        complain(Wrong(overlaps(machine)))

    _beside(lambda: ask(service, question), on_answer)


def _result(words):
    tell(words)
    show(Result(words))


#: for this session only; a preference would be a file that people send each other
_key = None


def _service():
    return service_at(url(), _key)


def _ask_key():
    global _key
    words = translate("Counterweight", f"Key of the service; never stored. {KEY} in the environment does the same.")
    text, consent = QtGui.QInputDialog.getText(Gui.getMainWindow(), "Counterweight", words, QtGui.QLineEdit.Password)
    if consent:
        _key = text or None


# ---- what was drawn


def _verify(machine):
    result = verify(machine)
    if not result.held:
        show(Result(result.words()))
        raise Wrong(result.words())
    _result(result.words())


def _clearance(machine):
    lines = clearance(machine)
    if lines:
        raise Wrong(lines)
    tell(["nothing is in the way of the counterweights"])


def _export(machine):
    folder = QtGui.QFileDialog.getExistingDirectory(Gui.getMainWindow(), translate("Counterweight", "Folder"))
    if folder:
        tell(map(str, export(machine, folder, _service())))


COMMANDS = {
    "Counterweight_Read": _Command(
        "read", "Read shaft", "Find axis, pins and webs of the selected bodies", _read, False
    ),
    "Counterweight_Balance": _Command("balance", "Balance", "Ask the service and draw the counterweights", _balance),
    "Counterweight_Verify": _Command("verify", "Verify", "Hold the solids against the answer", _verify),
    "Counterweight_Clearance": _Command("clearance", "Clearance", "Find collisions over a revolution", _clearance),
    "Counterweight_Export": _Command("export", "Export", "STEP, outlines, drawings, bill of material", _export),
    "Counterweight_Key": _Command("key", "Key", "Key of the service, for this session", _ask_key, False),
}
