"""What a designer should look at."""

from schemas.answer.shaft import Doubt, DoubtCode


def doubt(code: DoubtCode, number: int, message: str, serious: bool = False, of: str = "faces") -> Doubt:
    """A doubt about a face, or a body, of the request."""
    return Doubt(code=code, message=message, pointer=f"/{of}/{number}", serious=serious)
