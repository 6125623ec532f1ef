"""The backup of SQLite as the operation guide has it, on a database that is in use."""

import re
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

from service.jobs.database import Database
from service.jobs.fingerprints import fingerprint
from service.jobs.job import Order
from service.jobs.store import Store
from tests.deploy.files import ROOT


def test_the_copy_holds_what_was_written_last(tmp_path: Path) -> None:
    text = (ROOT / "docs" / "operation.md").read_text("utf-8")
    match = re.search(r"^python3 -c '(.+jobs\.sqlite.+)'$", text, re.MULTILINE)
    assert match is not None
    database = Database(tmp_path / "jobs.sqlite")
    store = Store(database)
    job, _ = store.submit(Order("sweep", b"{}", fingerprint("sweep", b"{}"), 3, 2))
    with database.read():
        # in use: what was submitted is in the write-ahead log still, and a plain copy of the file would miss it
        command = match[1].replace("/data/", f"{tmp_path}/")
        copy = tmp_path / "copy"
        copy.mkdir()
        subprocess.run([sys.executable, "-c", command], cwd=copy, check=True)
    database.close()
    with closing(sqlite3.connect(copy / "jobs.sqlite")) as restored:
        assert restored.execute("select id, total from jobs").fetchall() == [(job.id, 3)]
