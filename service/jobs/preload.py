"""Imported by the process that workers of the command ``sweep`` are forked from: loads what every chunk needs."""

import os

from service.jobs.worker import THREADS

# read by the libraries when they are imported
for _name in THREADS:
    os.environ[_name] = "1"

from optimizer.studies.sweep import chunk  # noqa: E402, F401
