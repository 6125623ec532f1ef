"""Codings in which answers go out: which there are, and what is worth compressing."""

import gzip
from typing import Literal, get_args

Coding = Literal["gzip", "zstd"]
#: the one that costs no further library first
CODINGS: tuple[Coding, ...] = get_args(Coding)
#: less fits into one segment anyway [bytes]
SMALL_BYTES = 1_000


def coded(content: bytes, coding: Coding) -> bytes:
    """Content in a coding; what an answer saves by more effort costs more than to send it."""
    if coding == "gzip":
        return gzip.compress(content, compresslevel=1, mtime=0)
    # few clients want this coding alone, and it takes half as much memory as all else that a worker holds
    import pyarrow as pa

    data: bytes = pa.compress(content, codec=coding, asbytes=True)
    return data
