"""Draw how a request travels: ``python docs/sequences.py`` writes the pictures of docs/architecture.md."""

from dataclasses import dataclass
from html import escape
from pathlib import Path

ROOT = Path(__file__).parents[1]
CLIENT = "client"


@dataclass(frozen=True)
class Message:
    """What one participant hands to another; a message to itself is work."""

    sender: str
    receiver: str
    content: str


@dataclass(frozen=True)
class Sequence:
    """Messages in their order between a client and files of the tree."""

    title: str
    messages: tuple[Message, ...]

    @property
    def participants(self) -> list[str]:
        """Those that send or receive, in the order of their first message."""
        return list(dict.fromkeys(name for message in self.messages for name in (message.sender, message.receiver)))


def _sequence(title: str, *messages: tuple[str, str, str]) -> Sequence:
    return Sequence(title, tuple(Message(*message) for message in messages))


_CONNECTIONS, _COMPUTING = "service/wire/connections.py", "service/http/computing.py"
_POOL, _WORKER = "service/workers/pool.py", "service/workers/worker.py"
_OPTIMIZE, _SOLVE = "optimizer/optimize.py", "optimizer/solve/"
_ROUTE, _STORE, _COORDINATOR = "service/routes/sweeps.py", "service/jobs/store.py", "service/jobs/coordinator.py"
_CHUNK_WORKER, _CHUNK = "service/jobs/worker.py", "optimizer/studies/sweep/chunk.py"
_INTAKE, _FILES, _LEASES = "service/jobs/intake.py", "service/jobs/files.py", "service/jobs/leases.py"
_RESULTS = "service/jobs/results.py"
_DOCUMENT, _CHAPTERS, _PDF = "service/report/document.py", "service/report/chapters/", "service/report/pdf.py"

SEQUENCES = {
    "sequence-post": _sequence(
        "POST /v1/optimize",
        (CLIENT, _CONNECTIONS, "bytes, within times and shares"),
        (_CONNECTIONS, _COMPUTING, "request, once its key is accepted"),
        (_COMPUTING, _POOL, "task: body, form, limits"),
        (_POOL, _WORKER, "task, when its client's turn comes"),
        (_WORKER, _WORKER, "read JSON, check it against schemas/"),
        (_WORKER, _OPTIMIZE, "OptimizeRequest"),
        (_OPTIMIZE, _OPTIMIZE, "simulate the effects: mechanics/"),
        (_OPTIMIZE, _SOLVE, "machine as arrays, objective"),
        (_SOLVE, _SOLVE, "formulate, minimise, prove: program/"),
        (_SOLVE, _OPTIMIZE, "counterweights, certificate, status"),
        (_OPTIMIZE, _WORKER, "OptimizeAnswer, every figure recomputed"),
        (_WORKER, _POOL, "JSON, compressed"),
        (_POOL, _COMPUTING, "answer, or the reason for none"),
        (_COMPUTING, CLIENT, "200, or problem+json"),
    ),
    "sequence-chunk": _sequence(
        "A chunk of a sweep: from POST /v1/sweeps to Parquet",
        (CLIENT, _ROUTE, "base request and axes"),
        (_ROUTE, _STORE, "new job, on disk before the 202"),
        (_ROUTE, CLIENT, "202, Location"),
        (_COORDINATOR, _LEASES, "lease some chunks of a job"),
        (_COORDINATOR, _CHUNK_WORKER, "request, first row, last row"),
        (_CHUNK_WORKER, _CHUNK, "blocks of rows of one shape"),
        (_CHUNK, _CHUNK_WORKER, "tables: a design is a row"),
        (_CHUNK_WORKER, _COORDINATOR, "piece: Parquet bytes, counts"),
        (_COORDINATOR, _INTAKE, "pieces that came together"),
        (_INTAKE, _FILES, "one Parquet file a chunk, with its digest"),
        (_INTAKE, _LEASES, "chunks are done, in one transaction"),
        (CLIENT, _ROUTE, "GET results, format=parquet"),
        (_ROUTE, _RESULTS, "files of the chunks that are done"),
        (_RESULTS, CLIENT, "rows, a batch at a time"),
    ),
    "sequence-report": _sequence(
        "POST /v1/report",
        (CLIENT, _COMPUTING, "request, Accept: application/pdf"),
        (_COMPUTING, _POOL, "task: body, form, limits"),
        (_POOL, _WORKER, "task, when its client's turn comes"),
        (_WORKER, _DOCUMENT, "ReportRequest"),
        (_DOCUMENT, _OPTIMIZE, "request, with the eight stages"),
        (_OPTIMIZE, _DOCUMENT, "OptimizeAnswer"),
        (_DOCUMENT, _CHAPTERS, "request and answer"),
        (_CHAPTERS, _DOCUMENT, "blocks: facts, tables, drawings"),
        (_DOCUMENT, _WORKER, "document: chapters, without a form"),
        (_WORKER, _PDF, "document"),
        (_PDF, _WORKER, "PDF, or html.py and terminal.py"),
        (_WORKER, CLIENT, "file, by pool and computing"),
    ),
}

_COLUMN, _LINE, _HEAD, _MARGIN = 190, 30, 52, 30


def picture(sequence: Sequence) -> str:
    """A column for each participant, a line for each message, from top to bottom in time."""
    names = sequence.participants
    at = {name: _MARGIN + _COLUMN * (number + 0.5) for number, name in enumerate(names)}
    width = 2 * _MARGIN + _COLUMN * len(names)
    height = _HEAD + _LINE * (len(sequence.messages) + 1) + _MARGIN
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"'
        ' font-family="sans-serif" font-size="11">',
        f"<title>{escape(sequence.title)}</title>",
        '<defs><marker id="tip" viewBox="0 0 6 6" refX="6" refY="3" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L6 3L0 6z" fill="#246"/></marker></defs>',
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
    ]
    for name, x in at.items():
        head = f'<text x="{x:.0f}" text-anchor="middle"'
        folder, _, file = name.rstrip("/").rpartition("/")
        lines.append(f'<path d="M{x:.0f} {_HEAD}V{height - _MARGIN}" stroke="#bbb" stroke-dasharray="3 3"/>')
        lines.append(f'{head} y="24" fill="#666">{folder + "/" if folder else ""}</text>')
        lines.append(f'{head} y="40" font-weight="bold">{file}</text>')
    for number, message in enumerate(sequence.messages, start=1):
        lines += _message(
            at[message.sender], at[message.receiver], _HEAD + _LINE * number, f"{number}. {message.content}"
        )
    return "\n".join([*lines, "</svg>\n"])


def _message(start: float, end: float, y: float, text: str) -> list[str]:
    if start == end:
        path, middle = f"M{start:.0f} {y:.0f}h12v8h-12", start
    else:
        path, middle = f"M{start:.0f} {y:.0f}H{end:.0f}", (start + end) / 2
    return [
        f'<path d="{path}" fill="none" stroke="#246" marker-end="url(#tip)"/>',
        f'<text x="{middle:.0f}" y="{y - 5:.0f}" text-anchor="middle" stroke="#fff" stroke-width="3"'
        f' paint-order="stroke">{escape(text)}</text>',
    ]


def main() -> None:
    """Write the pictures."""
    for name, sequence in SEQUENCES.items():
        (ROOT / "docs" / f"{name}.svg").write_text(picture(sequence))


if __name__ == "__main__":
    main()
