"""Files are whole, or as they were before."""

import os
from pathlib import Path

import pytest

from service.common.replacing import replaced


def test_a_file_is_there_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "file"
    with replaced(path) as file:
        file.write(b"whole")
        file.flush()
        assert not path.exists()
    assert path.read_bytes() == b"whole"
    assert os.listdir(tmp_path) == ["file"]


def test_one_that_fails_changes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"before")

    def half() -> None:
        with replaced(path) as file:
            file.write(b"half")
            raise ArithmeticError

    with pytest.raises(ArithmeticError):
        half()
    assert path.read_bytes() == b"before"
    assert os.listdir(tmp_path) == ["file"]


def test_several_at_a_time_do_not_meet(tmp_path: Path) -> None:
    """As threads, and the first processes of containers, which all have one process id."""
    path = tmp_path / ("long" * 60)
    with replaced(path) as io, replaced(path) as two:
        io.write(b"one")
        two.write(b"two")
    assert path.read_bytes() == b"one"
    assert os.listdir(tmp_path) == [path.name]


def test_rights_are_those_that_are_asked_for(tmp_path: Path) -> None:
    with replaced(tmp_path / "secret", 0o600):
        pass
    assert (tmp_path / "secret").stat().st_mode & 0o777 == 0o600
