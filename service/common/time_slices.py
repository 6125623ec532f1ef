"""Time slices: for how long a thread computes before another of its core may.

A thread with a short slice is woken at once while a computation with a longer one runs. It need not wait for the next
tick of the clock, which is up to four milliseconds away. Its share of the core stays what its niceness says.

Source: sched_setattr(2); Linux, Documentation/scheduler/sched-eevdf.rst. Linux heeds it from 6.12 on, and takes it
before without effect.
"""

import ctypes
import errno
import os
import platform
import struct

#: numbers of sched_setattr and sched_getattr, for which Python and the C library have no functions
_CALLS = {"x86_64": (314, 315), "aarch64": (274, 275), "riscv64": (274, 275)}
_LIBRARY = ctypes.CDLL(None, use_errno=True)
#: size, policy, flags, niceness, priority, slice [ns], and two times of other policies
_ATTRIBUTES = struct.Struct("=IIQiIQQQ")
#: policies that know slices: those of ordinary threads
_FAIR = (0, 3)
#: of short answers [s], the least that the system takes
SHORT_S = 0.0001


def set_slice(seconds: float | None) -> None:
    """Give the thread that calls, and threads that it starts later, a slice; that of the system for None.

    Raises
    ------
    OSError
        if the system has no slices, or does not allow it.
    """
    policy = os.sched_getscheduler(0) if hasattr(os, "sched_getscheduler") else -1
    if policy not in _FAIR:
        raise OSError(errno.ENOSYS, "no time slices here")
    niceness = os.getpriority(os.PRIO_PROCESS, 0)
    nanoseconds = 0 if seconds is None else round(seconds * 1e9)
    _call(0, _ATTRIBUTES.pack(_ATTRIBUTES.size, policy, 0, niceness, 0, nanoseconds, 0, 0), 0)


def slice_s() -> float:
    """The slice of the thread that calls [s]; 0 where the system heeds none.

    Raises
    ------
    OSError
        if the system has no slices.
    """
    buffer = _call(1, bytes(_ATTRIBUTES.size), _ATTRIBUTES.size, 0)
    return float(_ATTRIBUTES.unpack(buffer)[5]) / 1e9


def _call(number: int, attributes: bytes, *more: int) -> bytes:
    numbers = _CALLS.get(platform.machine())
    if numbers is None:
        raise OSError(errno.ENOSYS, "no time slices here")
    buffer = ctypes.create_string_buffer(attributes, len(attributes))
    if _LIBRARY.syscall(ctypes.c_long(numbers[number]), 0, buffer, *(ctypes.c_uint(argument) for argument in more)):
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return buffer.raw
