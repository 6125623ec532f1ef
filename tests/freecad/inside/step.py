"""The shaft of the batch test, as a file."""

import os

import FreeCAD as App
import shafts


def main():
    shafts.imported(App.newDocument("shaft"))
    return os.path.join(os.environ["FOLDER"], "imported.step")
