"""Pages of other origins: what they may ask, and problem details where they may not."""

from starlette.datastructures import Headers
from starlette.middleware.cors import CORSMiddleware
from starlette.responses import Response

from service.http.errors import PROBLEM_JSON, Fault, problem


class Cors(CORSMiddleware):
    """Refuses as everything else here is refused; the framework does so in plain text."""

    def preflight_response(self, request_headers: Headers) -> Response:
        found = super().preflight_response(request_headers)
        if found.status_code < 400:
            return found
        said = Fault(found.status_code, "Not allowed across origins", f"{bytes(found.body).decode()}.")
        refusal = Response(problem(said, "").model_dump_json(), found.status_code, media_type=PROBLEM_JSON)
        # what browsers are told, and caches must know
        kept = {name: value for name, value in found.headers.items() if name not in ("content-type", "content-length")}
        refusal.headers.update(kept)
        return refusal
