"""The limits of a machine in words, and what they cost."""

from collections.abc import Iterator, Sequence

from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.base.responses import ceilings
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Block, Chapter, Paragraph, table

_LIMITS = {
    "max_mass": "largest mass",
    "envelope": "envelope",
    "max_centrifugal_force": "largest centrifugal force",
    "sector": "sector",
    "max_total_mass": "largest total mass",
    **{ceiling.limit: f"ceiling of the {ceiling.label}" for ceiling in ceilings()},
    "bearing_ceiling": "ceiling of the bearing loads",
    "specific_load_ceiling": "ceiling of the specific bearing loads",
    "bending_ceiling": "ceiling of the bending moments",
}


def limits(names: Sequence[str]) -> str:
    """Limits in words."""
    return ", ".join(_LIMITS[name] for name in names)


def prices(answer: OptimizeAnswer) -> Iterator[Chapter]:
    """What the limits cost, where there are any prices."""
    if answer.shadow_prices:
        yield Chapter(
            "Prices of the limits",
            (
                Paragraph(
                    "A shadow price is the fall of the smallest objective per unit by which one limit is raised. The "
                    "objective is stated as a force: divided by the weight of the force. Where the force has no weight "
                    "it is stated as a moment, then as a bearing load, a bending moment or a roll moment. A sector is "
                    "opened to both sides. A price that the certificate cannot distinguish from 0 is given as 0."
                ),
                table(
                    "Shadow prices of the limits",
                    ["limit", "web", "#fall of the objective", "unit"],
                    [(limits([price.limit]), price.web, price.value, price.unit) for price in answer.shadow_prices],
                ),
            ),
        )


def without_prices(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[Block]:
    """Why there are no prices, where there are counterweights."""
    proof = answer.certificate
    if proof is None or answer.shadow_prices or not (answer.counterweights or answer.balance_shafts):
        return
    reason = _reason(request, proof)
    if reason is None:
        yield Paragraph("No limit holds the objective up: all shadow prices are 0.")
    else:
        yield Paragraph(f"There are no shadow prices {reason}.")


def _reason(request: OptimizeRequest, proof: Certificate) -> str | None:
    """Why prices of the limits are missing; None where they are there."""
    reasons = {
        "where nothing is proven": proof.gap is None,
        "of scenarios and tolerances, which have limits in every case": request.robust,
        "of goals in their order, which hold one another up": request.objective.priorities,
        "where webs form groups, of which none gives way by itself": request.machine.web_groups,
        "where counterweights are chosen from what there is": proof.nodes is not None,
    }
    return next((words for words, holds in reasons.items() if holds), None)
