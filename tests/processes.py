"""Processes that one has started, told apart by their names and command lines."""

import psutil

from tests.mould import FORK_SERVER


def children(pid: int, text: str) -> list[psutil.Process]:
    """The living children of a process whose command line holds `text`."""
    return [child for child in psutil.Process(pid).children() if text in _command(child)]


def fork_servers(pid: int) -> list[psutil.Process]:
    """The processes that a process forks its workers from; see tests/mould.py."""
    named = [child for child in psutil.Process(pid).children() if child.name() == FORK_SERVER]
    return [*named, *children(pid, "multiprocessing.forkserver")]


def _command(process: psutil.Process) -> str:
    try:
        return " ".join(process.cmdline())
    except psutil.NoSuchProcess:  # it has just ended, and may be unburied
        return ""
