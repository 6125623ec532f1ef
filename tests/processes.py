"""Processes that one has started, told apart by their names and command lines."""

from contextlib import suppress
from pathlib import Path

import psutil

from tests.mould import FORK_SERVER


def all_children(pid: int) -> list[psutil.Process]:
    """The children of a process, as the system lists them: psutil looks through all processes there are."""
    processes = []
    for listed in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(OSError):
            for child in listed.read_text().split():
                with suppress(psutil.NoSuchProcess):
                    processes.append(psutil.Process(int(child)))
    return processes


def children(pid: int, text: str) -> list[psutil.Process]:
    """The living children of a process whose command line holds `text`."""
    return [child for child in all_children(pid) if text in _command(child)]


def fork_servers(pid: int) -> list[psutil.Process]:
    """The processes that a process forks its workers from; see tests/mould.py."""
    return [child for child in all_children(pid) if _forks(child)]


def _forks(process: psutil.Process) -> bool:
    try:
        return process.name() == FORK_SERVER or "multiprocessing.forkserver" in _command(process)
    except psutil.NoSuchProcess:
        return False


def _command(process: psutil.Process) -> str:
    try:
        return " ".join(process.cmdline())
    except psutil.NoSuchProcess:  # it has just ended, and may be unburied
        return ""
