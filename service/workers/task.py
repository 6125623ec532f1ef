"""The task of a worker: bytes over a socket, of which all but the body are the same again and again."""

import pickle
import struct
from enum import IntEnum
from functools import lru_cache
from typing import BinaryIO

from optimizer.numerics.records import record
from service.common.coding import Coding
from service.computations.computation import Computation, Form
from service.guard.sizes import SizeLimits

#: its priority, and how many bytes follow that say what to do, and with what
_HEAD = struct.Struct("!BIQ")
#: of what to do there are some for each computation
_CACHE_SIZE = 256


class Priority(IntEnum):
    """Before whom a task is computed.

    Of a client who has no other; further ones of a client, and those that give way to who asks now and then; long ones.
    """

    FIRST = 0
    FURTHER = 1
    LONG = 2


@record(frozen=True)
class Task:
    """What to compute, and in which form and coding to answer; all data: what it names is looked up in the worker.

    workbook : whether the body is one; else it is JSON.
    long : it has a turn of the long ones; else a worker that finds it to be long hands it back.
    """

    computation: Computation
    form: Form
    body: bytes
    limits: SizeLimits
    coding: Coding | None = None
    workbook: bool = False
    long: bool = False

    def serialize(self, priority: Priority) -> bytes:
        """The task as it goes to a worker."""
        order = _ORDERS.bytes_of((self.computation, self.form, self.limits, self.coding, self.workbook, self.long))
        return b"".join((_HEAD.pack(priority, len(order), len(self.body)), order, self.body))

    @classmethod
    def receive(cls, stream: BinaryIO) -> tuple["Task", Priority]:
        """The next task in a stream, and its priority.

        Raises
        ------
        EOFError
            if nobody asks any more.
        """
        priority, order, body = _HEAD.unpack(_read(stream, _HEAD.size))
        computation, form, limits, coding, workbook, long = _deserialize(_read(stream, order))
        return cls(computation, form, _read(stream, body), limits, coding, workbook, long), Priority(priority)


class _Orders:
    """Orders as bytes, pickled once: dozens of names cost more than to check a request, and so does their hash."""

    def __init__(self) -> None:
        # an order stays as long as the identities of its parts
        self._entries: dict[tuple[int, ...], tuple[tuple[object, ...], bytes]] = {}

    def bytes_of(self, order: tuple[object, ...]) -> bytes:
        """An order as bytes; equal ones need not be the same."""
        identity = tuple(map(id, order))
        entry = self._entries.get(identity)
        if entry is None:
            if len(self._entries) >= _CACHE_SIZE:
                self._entries.clear()
            entry = self._entries[identity] = order, pickle.dumps(order)
        return entry[1]


_ORDERS = _Orders()


@lru_cache(_CACHE_SIZE)
def _deserialize(order: bytes) -> tuple[Computation, Form, SizeLimits, Coding | None, bool, bool]:
    result: tuple[Computation, Form, SizeLimits, Coding | None, bool, bool] = pickle.loads(order)
    return result


def _read(stream: BinaryIO, size: int) -> bytes:
    content = stream.read(size)
    if len(content) < size:
        raise EOFError
    return content
