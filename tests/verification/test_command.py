"""The checker as a command: what it prints, its exit codes, and the files that it reads."""

import io
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from service.verification import checker
from tests.verification.recorded import records
from tests.verification.test_curves import part

_CLAIMS: list[dict[str, Any]] = [
    {"claim": "objective", "verdict": "held", "margin": 1.26e-9, "where": "/answer/certificate/objective"},
    {"claim": "lower_bound", "verdict": "not covered", "margin": None, "where": "/answer/certificate/lower_bound"},
]


@pytest.mark.parametrize(("verdict", "code"), [("held", 0), ("broken", 1), ("not covered", 3)])
def test_a_line_for_each_claim_and_a_code(
    verdict: str, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, file = tmp_path / "request.json", tmp_path / "answer.json"
    path.write_text('{"a": 1}', "utf-8")
    file.write_text('{"b": 2}', "utf-8")

    def check(request: Any, answer: Any) -> dict[str, Any]:
        assert (request, answer) == ({"a": 1}, {"b": 2})
        return {"claims": _CLAIMS, "not_covered": ["/answer/x"], "checked": 3, "leaves": 4, "verdict": verdict}

    assert part("claims").main(check, "usage", [str(path), str(file)]) == code
    assert capsys.readouterr().out.splitlines() == [
        "objective          held           1.3e-09  /answer/certificate/objective",
        "lower_bound        not covered             /answer/certificate/lower_bound",
        "                   not covered             /answer/x",
        f"{verdict}: 3 of 4 claims are checked",
    ]


@pytest.mark.parametrize("count", [0, 1, 3])
def test_two_files_are_needed(count: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert part("claims").main(lambda *_: {}, "two files", ["a.json"] * count) == 2
    assert capsys.readouterr() == ("", "two files\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [("{", "is not JSON: "), ("[" * 100_000, ""), ('{"a": 1}\n{', "is not JSON: "), ("\ud800", "")],
)
def test_what_is_no_json_is_named(text: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bad = tmp_path / "bad.json"
    bad.write_bytes(text.encode("utf-8", "surrogatepass"))
    assert part("claims").main(lambda *_: {}, None, [str(bad), str(bad)]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert message in printed.err
    assert part("claims").main(lambda *_: {}, None, [str(tmp_path / "none.json")] * 2) == 2


def test_rows_are_read_line_by_line_and_an_answer_from_the_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = tmp_path / "rows.ndjson"
    rows.write_bytes('\ufeff{"index": 0}\n\n{"index": 1}\n'.encode())
    assert part("numbers").read(str(rows)) == [{"index": 0}, {"index": 1}]
    monkeypatch.setattr("sys.stdin", SimpleNamespace(buffer=io.BytesIO(b'{"a": 1}')))
    assert part("numbers").read("-") == {"a": 1}


def test_no_more_is_looked_at_than_is_allowed() -> None:
    """Analytic: numbers, texts, objects and lists of the answer, and those of the request once, or for every row."""
    body = {"base": {"x": 1, "y": "a"}, "axes": []}
    rows = [{"index": 0, "status": "failed"}, {"index": 1, "status": "failed"}]
    assert checker().verify(body, rows, most=17)["checked"] == 0
    with pytest.raises(checker().Unreadable, match="17 of 16 numbers and texts"):
        checker().verify(body, rows, most=16)
    actual_sum = records()["sum"]
    leaves = _places(actual_sum["request"]) + _places(actual_sum["answer"])
    assert checker().verify(actual_sum["request"], actual_sum["answer"], most=leaves)["verdict"] == "held"
    with pytest.raises(checker().Unreadable, match=f"{leaves} of {leaves - 1} numbers"):
        checker().verify(actual_sum["request"], actual_sum["answer"], most=leaves - 1)


def _places(value: Any) -> int:
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + sum(map(_places, inner))


def test_codes_are_told_apart() -> None:
    assert checker().CODES == {"held": 0, "broken": 1, "not covered": 3}
