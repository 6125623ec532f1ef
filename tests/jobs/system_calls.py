"""A child that is killed at one of its system calls. It is stopped at each of them, as debuggers stop programs: ptrace.

The end of a process undoes nothing that the kernel has begun, so it can die before a call, or, where a call writes to a
file, half way through it.
"""

import ctypes
import os
import platform
import signal
import sys
from collections.abc import Callable

# linux/ptrace.h
_TRACEME, _POKEUSER, _SYSCALL, _SETOPTIONS, _SYSCALL_INFO = 0, 6, 24, 0x4200, 0x420E
#: stops at calls are told from signals by a bit, and the child does not outlive us
_OPTIONS = 1 | 1 << 20
_STOPPED_AT_CALL = signal.SIGTRAP | 0x80
_ENTRY = 1
#: numbers of write and pwrite64, and where the third argument of a call is kept, by machine; elsewhere none is halved
_WRITES, _LENGTH_AT = {"x86_64": ({1, 18}, 96)}.get(platform.machine(), (set(), 0))


class Missing(Exception):
    """Processes cannot be traced here."""


class _Info(ctypes.Structure):
    _fields_ = (
        ("op", ctypes.c_uint8),
        ("padding", ctypes.c_uint8 * 3),
        ("arch", ctypes.c_uint32),
        ("instruction", ctypes.c_uint64),
        ("stack", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("arguments", ctypes.c_uint64 * 6),
    )


def killed(work: Callable[[], None], at: int | None = None, half: bool = False) -> list[bool]:
    """Do some work in a child, which dies without a word at a system call.

    Parameters
    ----------
    at : at which of its calls, counted from 0; before it, or half way through it. At none, it lives to the end.

    Returns
    -------
    the calls that it came to, each with whether it writes and so can be done by half.

    Raises
    ------
    Missing
    """
    child = os.fork()
    if child == 0:
        try:
            _ptrace(_TRACEME, 0, 0, 0)
            os.kill(os.getpid(), signal.SIGSTOP)
            work()
        except Missing:
            os._exit(77)
        except BaseException:
            sys.excepthook(*sys.exc_info())
            os._exit(1)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    if not os.WIFSTOPPED(status):
        raise Missing("processes cannot be traced here")
    _ptrace(_SETOPTIONS, child, 0, _OPTIONS)
    calls: list[bool] = []
    while (call := _next_call(child)) is not None:
        halves = call.number in _WRITES and call.arguments[2] > 1
        calls.append(halves)
        if len(calls) - 1 == at:
            if half:
                _ptrace(_POKEUSER, child, _LENGTH_AT, call.arguments[2] // 2)
                _next_stop(child, 0)
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            return calls
    return calls


def _next_call(child: int) -> _Info | None:
    """Let a child go on to where its next system call begins; None if it has ended well instead."""
    deliver = 0
    while True:
        status = _next_stop(child, deliver)
        if not os.WIFSTOPPED(status):
            assert os.waitstatus_to_exitcode(status) == 0, "the work was not done"
            return None
        stop = os.WSTOPSIG(status)
        deliver = 0 if stop == _STOPPED_AT_CALL else stop
        if stop == _STOPPED_AT_CALL:
            info = _Info()
            _ptrace(_SYSCALL_INFO, child, ctypes.sizeof(info), ctypes.addressof(info))
            if info.op == _ENTRY:
                return info


def _next_stop(child: int, deliver: int) -> int:
    _ptrace(_SYSCALL, child, 0, deliver)
    return os.waitpid(child, 0)[1]


def _ptrace(request: int, child: int, address: int, data: int) -> None:
    pointer = ctypes.CDLL(None, use_errno=True).ptrace
    pointer.argtypes, pointer.restype = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p], ctypes.c_long
    if pointer(request, child, address, data) < 0:
        raise Missing(f"processes cannot be traced here: {os.strerror(ctypes.get_errno())}")
