"""Runs a module of this folder in FreeCAD: what its `main` returns goes to a file, what it raises is an exit code.

FreeCAD itself would end with 0 whatever a script raises.
"""

import importlib
import json
import os
import sys
import traceback


def main():
    sys.path.insert(0, os.environ["INSIDE"])
    try:
        report = importlib.import_module(os.environ["SCRIPT"]).main()
        with open(os.environ["FOUND"], "w") as file:
            json.dump(report, file)
    except BaseException:
        traceback.print_exc(file=sys.stdout)
        sys.stdout.flush()
        os._exit(1)
    # nothing of FreeCAD's way out is of interest
    sys.stdout.flush()
    os._exit(0)


main()
