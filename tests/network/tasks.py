"""What the workers of the tests compute."""

import json
import os
import signal
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from schemas.answer.problem import Problem
from schemas.request.requests import OptimizeRequest
from service.common.time_slices import slice_s
from service.computations.computation import JSON
from service.computations.table import COMPUTATIONS
from service.documents.examples import load
from service.guard.sizes import SizeLimits
from service.settings import Settings
from service.workers.task import Task

_DONE = Problem(type="t", title="t", status=200, detail="d", instance="", errors=())


def quick(_: OptimizeRequest) -> Problem:
    return _DONE


def niceness(_: OptimizeRequest) -> Problem:
    """How nice the thread that computes it is, and the process that it belongs to."""
    own, process = (os.getpriority(os.PRIO_PROCESS, count) for count in (0, os.getpid()))
    time.sleep(0.2)
    return Problem(**{**_DONE.model_dump(), "title": f"{own} {process}"})


def slices(_: OptimizeRequest) -> Problem:
    """The time slice of the thread that computes it [ns]."""
    return Problem(**{**_DONE.model_dump(), "title": str(round(slice_s() * 1e9))})


def lowered(_: OptimizeRequest) -> Problem:
    """How nice its thread is at first, and after it has computed until that changes, for a second at most."""
    first = os.getpriority(os.PRIO_PROCESS, 0)
    while (now := os.getpriority(os.PRIO_PROCESS, 0)) == first and time.thread_time() < 1:
        pass
    return Problem(**{**_DONE.model_dump(), "title": f"{first} {now}"})


def slow(_: OptimizeRequest) -> Problem:
    time.sleep(1)
    return _DONE


def mostly_idle(_: OptimizeRequest) -> Problem:
    until = time.thread_time() + 0.1
    while time.thread_time() < until:
        pass
    time.sleep(1)
    return _DONE


def endless(_: OptimizeRequest) -> Problem:
    time.sleep(600)
    return _DONE


def hungry(_: OptimizeRequest) -> Problem:
    return Problem(**{**_DONE.model_dump(), "title": "x" * len(bytearray(3_000_000_000))})


def faulty(request: OptimizeRequest) -> Problem:
    raise RuntimeError(f"secret {request.machine.name}")


def deadly(_: OptimizeRequest) -> Problem:
    os.kill(os.getpid(), signal.SIGKILL)
    return _DONE


def deadly_once(request: OptimizeRequest) -> Problem:
    """Dies once; the file that its machine is named after tells the second time from the first."""
    if not Path(request.machine.name).exists():
        Path(request.machine.name).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return _DONE


def large(_: OptimizeRequest) -> Problem:
    return Problem(**{**_DONE.model_dump(), "title": "x" * 5_000_000})


def task(compute: Callable[[OptimizeRequest], Problem], name: str = "x", long: bool = False) -> Task:
    """A task that has the machine of an example, with another name."""
    body = json.loads(load("w60"))
    body["machine"]["name"] = name
    content = json.dumps(body).encode()
    reference = f"{compute.__module__}:{compute.__name__}"
    computation = replace(COMPUTATIONS["optimize"], compute=reference)
    return Task(computation, JSON, content, SizeLimits.of(Settings()), long=long)
