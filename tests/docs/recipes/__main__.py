"""``python -m tests.docs.recipes file arguments``: a script whose workers do not run it anew, as with ``python -c``."""

import runpy
import sys

sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="script")
