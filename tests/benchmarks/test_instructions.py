"""Counts of callgrind, read: every figure of the sample is counted by hand (analytic)."""

from pathlib import Path

import pytest

from tests.benchmarks.instructions import Cost, by_library, main

SAMPLE = """# callgrind format
events: Ir Dr Dw I1mr D1mr D1mw ILmr DLmr DLmw

ob=(1) /usr/lib/libpython.so
fl=(1) ceval.c
fn=(1) evaluate
10 100 40 20 3 2 1
+2 50
cob=(2) /site/numpy.so
cfn=(2) add
calls=4 7
* 900 300 200 90 80 70 60 50 40

ob=(2)
fn=(2)
7 900 300 200 90 80 70 60 50 40
ob=(1)
fn=(3) free
-3 10
"""


def test_each_library_has_what_it_cost_itself() -> None:
    # what was called counts where it ran, and a name in parentheses stands for what was named before
    costs = by_library(SAMPLE.splitlines(keepends=True), 10)
    assert costs == {
        "libpython.so": Cost(instructions=16.0, first_instructions=0.3, first_data=pytest.approx(0.3), second=0.0),
        "numpy.so": Cost(instructions=90.0, first_instructions=9.0, first_data=15.0, second=15.0),
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [([], "valgrind is not installed"), (["--answers", "0"], "--answers: at least 1"), (["--case", "x"], "--case")],
)
def test_a_wrong_command_is_refused_in_a_line(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("sys.argv", ["instructions", *arguments])
    # nothing is installed there
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert message in capsys.readouterr().err.splitlines()[-1]
