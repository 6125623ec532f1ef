"""Names that browsers save an answer under."""

import re
from unicodedata import normalize
from urllib.parse import quote

#: what stands for something else in a path, a header, or a file system
_UNSAFE = re.compile(r"[^\w .()+,=@-]+")
_LONGEST = 100
_NAMELESS = "document"


def file_name(stem: str, suffix: str) -> str:
    """The parameters of Content-Disposition for a name in any script (RFC 6266, with RFC 8187 where it is not ASCII).

    Parameters
    ----------
    stem : any text; what no file name holds becomes a hyphen.
    suffix : with its dot.
    """
    # a letter with its mark is a letter of its own; alone the mark would be none
    safe = _UNSAFE.sub("-", normalize("NFC", stem))[:_LONGEST].strip(" .-") or _NAMELESS
    plain = safe.encode("ascii", "ignore").decode().strip(" .-") or _NAMELESS
    simple = f'filename="{plain}{suffix}"'
    return simple if plain == safe else f"{simple}; filename*=UTF-8''{quote(safe + suffix)}"
