"""Pages of other origins: what they may ask, and problem details where they may not."""

from collections.abc import Awaitable

from starlette.datastructures import Headers
from starlette.middleware.cors import CORSMiddleware
from starlette.responses import Response
from starlette.types import Message, Receive, Scope, Send

from service.common.headers import header
from service.common.problems import PROBLEM_JSON, Fault, problem


class Cors(CORSMiddleware):
    """Refuses as everything else here is refused; the framework does so in plain text."""

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:  # type: ignore[override]
        if scope["type"] != "http" or header(scope, b"origin") is not None:
            return super().__call__(scope, receive, send)

        # there is nothing to decide, but it would be answered otherwise with the header
        def vary(message: Message) -> Awaitable[None]:
            if message["type"] == "http.response.start":
                headers = message.get("headers", ())
                varies = b", ".join([*[value for name, value in headers if name == b"vary"], b"Origin"])
                message["headers"] = [*[header for header in headers if header[0] != b"vary"], (b"vary", varies)]
            return send(message)

        return self.app(scope, receive, vary)

    def preflight_response(self, request_headers: Headers) -> Response:
        response = super().preflight_response(request_headers)
        if response.status_code < 400:
            return response
        fault = Fault(response.status_code, "Not allowed across origins", f"{bytes(response.body).decode()}.")
        refusal = Response(problem(fault, "").model_dump_json(), response.status_code, media_type=PROBLEM_JSON)
        # fields for browsers and caches
        fields = {
            name: value for name, value in response.headers.items() if name not in ("content-type", "content-length")
        }
        refusal.headers.update(fields)
        return refusal
