"""Images that a request holds: PNG files as data URLs, small, and whole to the last checksum."""

import base64
import binascii
import struct
import zlib
from collections.abc import Iterator

from pydantic_core import PydanticCustomError

_URL = "data:image/png;base64,"
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_MOST_PIXELS = 2000
#: samples of a pixel by type of colour
_SAMPLES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
_PALETTE = 3
#: largest filter of a line that there is
_FILTERS = 4


def png_url(url: str) -> str:
    """A data URL whose file can be shown."""
    try:
        png(url)
    except (ValueError, binascii.Error, struct.error, zlib.error):
        message = "a whole PNG file of at most 2000 pixels a side, not interlaced: data:image/png;base64,..."
        raise PydanticCustomError("image", message) from None
    return url


def png(url: str) -> bytes:
    """The file in a data URL, with nothing in it but its pixels: no reader has to bear what else it may hold.

    Raises
    ------
    ValueError, struct.error, zlib.error
    """
    content = base64.b64decode(url.removeprefix(_URL), validate=True)
    if not (url.startswith(_URL) and content.startswith(_SIGNATURE)):
        raise ValueError(url[:30])
    parts = list(_parts(content))
    head = parts[0][1]
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", head)
    if not (0 < width <= _MOST_PIXELS and 0 < height <= _MOST_PIXELS) or depth not in (1, 2, 4, 8) or interlaced:
        raise ValueError(width)
    if colour not in _SAMPLES or (depth < 8 and colour not in (0, _PALETTE)):
        raise ValueError(colour)
    line = 1 + -(-width * depth * _SAMPLES[colour] // 8)
    stream = b"".join(data for name, data in parts if name == b"IDAT")
    pixels = zlib.decompressobj().decompress(stream, height * line + 1)
    if len(pixels) != height * line or max(pixels[::line]) > _FILTERS:
        raise ValueError(len(pixels))
    # a pixel may name no colour beyond the palette
    room = 3 * 2**depth
    palette = next((data for name, data in parts if name == b"PLTE"), b"")[:room].ljust(room, b"\0")
    chunks = [(b"IHDR", head), *([(b"PLTE", palette)] if colour == _PALETTE else []), (b"IDAT", zlib.compress(pixels))]
    return _SIGNATURE + b"".join(_part(name, data) for name, data in [*chunks, (b"IEND", b"")])


def _part(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def _parts(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    place = len(_SIGNATURE)
    while place < len(content):
        (length,) = struct.unpack_from(">I", content, place)
        name, data = content[place + 4 : place + 8], content[place + 8 : place + 8 + length]
        if content[place + 8 + length : place + 12 + length] != _part(name, data)[-4:]:
            raise ValueError(name)
        yield name, data
        place += 12 + length
