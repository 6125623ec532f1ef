"""Settings of the whole test run."""

from hypothesis import settings

# times are for benchmarks, and a run that failed must fail again
settings.register_profile("counterweight", deadline=None, derandomize=True)
settings.load_profile("counterweight")
