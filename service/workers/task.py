"""What a worker is asked: bytes over a socket, of which all but the body are the same again and again."""

import pickle
import struct
from dataclasses import dataclass
from functools import lru_cache
from typing import BinaryIO

from service.coding import Coding
from service.computations import Computation, Form
from service.guard.sizes import SizeLimits

#: whether it is computed behind others, and how many bytes follow that say what to do, and with what
_HEAD = struct.Struct("!?IQ")
#: of what to do there are some for each computation
_KEPT = 256


@dataclass(frozen=True)
class Task:
    """What to compute, and in which form and coding to answer; all data: what it names is looked up in the worker.

    workbook : whether the body is one; else it is JSON.
    """

    computation: Computation
    form: Form
    body: bytes
    limits: SizeLimits
    coding: Coding | None = None
    workbook: bool = False

    def said(self, behind: bool) -> bytes:
        """The task as it goes to a worker, behind what others have asked for or not."""
        order = _said(self.computation, self.form, self.limits, self.coding, self.workbook)
        return b"".join((_HEAD.pack(behind, len(order), len(self.body)), order, self.body))

    @classmethod
    def heard(cls, stream: BinaryIO) -> tuple["Task", bool]:
        """The next task in a stream, and whether it is behind others.

        Raises
        ------
        EOFError
            if nobody asks any more.
        """
        behind, order, body = _HEAD.unpack(_read(stream, _HEAD.size))
        computation, form, limits, coding, workbook = _heard(_read(stream, order))
        return cls(computation, form, _read(stream, body), limits, coding, workbook), behind


# pickled and read once: dozens of names cost more than to check a request
@lru_cache(_KEPT)
def _said(*order: object) -> bytes:
    return pickle.dumps(order)


@lru_cache(_KEPT)
def _heard(order: bytes) -> tuple[Computation, Form, SizeLimits, Coding | None, bool]:
    found: tuple[Computation, Form, SizeLimits, Coding | None, bool] = pickle.loads(order)
    return found


def _read(stream: BinaryIO, size: int) -> bytes:
    found = stream.read(size)
    if len(found) < size:
        raise EOFError
    return found
