"""Settings of the whole test run."""

import os
import tempfile

from hypothesis import settings

# no test may touch the jobs of whoever runs it; processes that tests start inherit this
_DATA = tempfile.TemporaryDirectory(prefix="counterweight-tests-")
os.environ["COUNTERWEIGHT_DATA_DIR"] = _DATA.name

# times are for benchmarks, and a run that failed must fail again
settings.register_profile("counterweight", deadline=None, derandomize=True)
settings.load_profile("counterweight")
