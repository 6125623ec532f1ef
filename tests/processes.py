"""Processes that one has started, told apart by their command lines."""

import psutil


def children(pid: int, text: str) -> list[psutil.Process]:
    """The living children of a process whose command line holds `text`."""
    return [child for child in psutil.Process(pid).children() if text in _command(child)]


def _command(process: psutil.Process) -> str:
    try:
        return " ".join(process.cmdline())
    except psutil.NoSuchProcess:  # it has just ended, and may be unburied
        return ""
