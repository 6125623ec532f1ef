"""Which weighed part goes on which row: the rows with their parts, what it brings, how far it is proven."""

from collections.abc import Iterator

from schemas.match.answer import MatchAnswer, MatchedRow
from schemas.match.request import MatchRequest
from service.report.blocks import Chapter, Paragraph, angle, facts, table
from service.report.chapters.balance import places

_PROVEN = {
    "exhaustion": "every assignment counts, those that a bound excludes are left out",
    "sorting": "the best of a search, beside the bound that sorting the masses proves",
}


def matched(request: MatchRequest, answer: MatchAnswer) -> Iterator[Chapter]:
    """Parts row by row, force and moment before and after, and the certificate."""
    kinds = list(dict.fromkeys(assignment.kind for assignment in answer.assignments))
    on = {(assignment.throw, assignment.row, assignment.kind): assignment for assignment in answer.assignments}
    rows = []
    for row in answer.rows:
        parts = (on.get((row.throw, row.row, kind)) for kind in kinds)
        cells = (cell for part in parts for cell in (("", "") if part is None else (part.part, part.mass_kg)))
        rows.append((_name(request, row), *cells, row.reciprocating_mass_kg))
    heads = [head for kind in kinds for head in (f"<{kind}", "#kg")]
    blocks = [table("", ["row", *heads, "#reciprocating mass, kg"], rows)]
    if answer.spares:
        left = ((spare.kind, spare.part, spare.mass_kg) for spare in answer.spares)
        blocks.append(table("Left over", ["", "part", "#kg"], list(left)))
    yield Chapter("Parts on rows", tuple(blocks))
    before, after = answer.residual.before, answer.residual.after
    peaks = [
        ("peak force, N", before.force.peak_N, after.force.peak_N),
        ("peak moment, N m", before.moment.peak_Nm, after.moment.peak_Nm),
        ("objective", answer.certificate.objective_as_listed, answer.certificate.objective),
    ]
    yield Chapter("First order", (table("", ["", "#as listed", "#as matched"], peaks),))
    if answer.counterweights:
        fitted = [
            (counterweight.web, counterweight.mass_kg, angle(counterweight.angle_deg))
            for counterweight in answer.counterweights
        ]
        title = "Counterweights, chosen" if request.choose_counterweights else "Counterweights, as given"
        yield Chapter(title, (table("", ["web", "#mass, kg", "#angle, deg"], fitted),))
    for shaft in answer.balance_shafts:
        yield Chapter(f"Balance shaft {shaft.name}", (Paragraph(shaft.gearing), places(shaft.counterweights)))
    proof = facts(
        "",
        [
            ("proven by", f"{answer.certificate.method}: {_PROVEN[answer.certificate.method]}"),
            ("no assignment has an objective below", answer.certificate.lower_bound),
            ("gap", answer.certificate.gap),
            ("gap over the objective as listed", answer.certificate.relative_gap),
        ],
    )
    yield Chapter("Certificate", (Paragraph(answer.status_reason), proof))


def _name(request: MatchRequest, row: MatchedRow) -> str:
    throw = request.machine.throws[row.throw].name or str(row.throw + 1)
    return f"throw {throw}, row {row.name or row.row + 1}"
