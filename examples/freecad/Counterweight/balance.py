"""Run by ``freecadcmd balance.py``: see freecad/counterweight/batch.py, which says what it reads and writes."""

import os
import sys
import traceback

import freecad

try:
    # where it is not installed, it is beside this file
    freecad.__path__.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "freecad"))
    from freecad.counterweight.batch import run

    code = run()
except BaseException:
    # FreeCAD would print one line and end with 0
    traceback.print_exc(file=sys.stdout)
    code = 1
sys.stdout.flush()
os._exit(code)
