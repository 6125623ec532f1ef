"""Settings of the whole test run."""

import gc
import importlib
import logging
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

# read when these libraries are loaded: a process that has threads is not forked, see tests/forks.py
os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["JE_ARROW_MALLOC_CONF"] = "background_thread:false"

from optimizer.warm_up import warm_up
from service.workers.process import preload
from tests.economy import collect_seldom, collect_young, make_characters
from tests.fork_server import fork_fork_servers
from tests.mould import DOCUMENTS
from tests.night import ALL
from tests.verification.every import check_answers

# with `-n 4`, or `--numprocesses 4`, in four processes
pytest_plugins = ["tests.forks"]

# no test may touch the jobs of whoever runs it; processes that tests start inherit this
_DATA = tempfile.TemporaryDirectory(prefix="counterweight-tests-")
os.environ["COUNTERWEIGHT_DATA_DIR"] = _DATA.name
# the host that the test client names; a service without keys answers for no others than this machine
os.environ["COUNTERWEIGHT_ALLOWED_HOSTS"] = "testserver"
# a machine that is busy is no database that is away, and no computation that does not end
os.environ["COUNTERWEIGHT_DATABASE_BUSY_S"] = "60"
os.environ["COUNTERWEIGHT_REQUEST_TIMEOUT_S"] = "600"

# times are for benchmarks, and a run that failed must fail again;
# under mutants there are a few more; HYPOTHESIS_PROFILE=night looks at twenty times as many, =thorough at many more,
# other ones each time
quick = {"deadline": None, "derandomize": True, "database": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("quick", max_examples=20 if ALL else 10, **quick)
settings.register_profile("night", max_examples=300, **quick)
settings.register_profile("thorough", deadline=None, max_examples=1000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "quick"))
# else the numbers that stand in whatever modules are loaded are tried too: other ones after other tests, see
# tests/test_examples.py
providers.is_local_module_file = lambda _: False

# jsonschema compiles forty grammars of addresses with it when it is imported, nearly a second of every process; no test
# asks for that format
sys.modules["rfc3987_syntax"] = None  # type: ignore[assignment]

#: tests for which kernels are loaded and models built before they are handed out to several processes
_MANY = 1000

collect_seldom()

# what processes that tests start are forked from, whichever of them is the first
preload()
fork_fork_servers()

# a certificate that its own answer refutes fails the test that asked for it, whatever that looks at
check_answers()


@pytest.fixture(scope="module", autouse=True)
def server_log_reaches_the_root() -> Iterator[None]:
    """The file that gives the server's log another way fails, not the one that looks for its lines afterwards."""
    yield
    for name in ("uvicorn", "uvicorn.error"):
        logger = logging.getLogger(name)
        assert (logger.propagate, logger.handlers) == (True, []), f"{name} keeps what this file did to it: log_config"


@pytest.fixture(scope="module", autouse=True)
def cycles_of_the_file() -> Iterator[None]:
    """The file that leaves something open in a cycle fails, not the one in whose time it is looked for."""
    yield
    collect_young()


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Modules and tests stay until the end: three quarters of a million objects to look through, again and again."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_collection_finish(session: pytest.Session) -> None:
    """What is loaded is loaded. Where there are tests of the service, its document is made once."""
    served = "service.http.openapi" in sys.modules
    if served:
        importlib.import_module("tests.documents").keep_documents()
    option = session.config.getoption
    if option("numprocesses") and len(session.items) > _MANY and not option("collectonly"):
        # as else each process would, with its first answer, its first text and its first document
        warm_up()
        make_characters()
        if served:
            documents = importlib.import_module("tests.documents")
            documents.make_documents()
            file = Path(_DATA.name) / "documents"
            documents.write_documents(file)
            # for the process that services are forked from, until it has started
            os.environ[DOCUMENTS] = str(file)
        gc.collect()
        gc.freeze()
    for name in ("OPENBLAS_NUM_THREADS", "JE_ARROW_MALLOC_CONF"):
        os.environ.pop(name, None)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """What could not be tested here is said aloud."""
    reasons = Counter(report.longrepr[2] for report in terminalreporter.stats.get("skipped", ()))
    for reason, count in reasons.items():
        terminalreporter.section(f"{count} NOT RUN. {reason}", sep="!", red=True, bold=True)
