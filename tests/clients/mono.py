"""Mono, which runs the example in C#: where it is, and how it is installed (``python -m tests.clients.mono``)."""

import shutil

from tests.debian import install, say_missing

#: compiler, runtime, and the two libraries that the example uses
_PACKAGES = (
    "mono-mcs", "mono-runtime", "libmono-system-net-http4.0-cil", "libmono-system-runtime-serialization4.0-cil",
)  # fmt: skip
_INSTALL_WITHIN_S = 120.0
MISSING = "Mono is missing: the example in C# was NOT RUN. Install it (Debian: apt-get install mono-mcs mono-runtime)."


def installed() -> bool:
    """Whether compiler and runtime are there."""
    return shutil.which("mcs") is not None and shutil.which("mono") is not None


def main() -> None:
    if not installed():
        install(*_PACKAGES, within_s=_INSTALL_WITHIN_S)
    if not installed():
        say_missing(MISSING)


if __name__ == "__main__":
    main()
