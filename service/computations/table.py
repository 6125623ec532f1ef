"""The table of computations: one entry is all that a new one takes."""

from service.computations.computation import JSON, XLSX, Computation, Form, Reference


def _document(suffix: str, media_type: str, write: Reference, styles: str = "", compressed: bool = False) -> Form:
    """A form of the report; a browser may do nothing while it shows one but use the styles in it."""
    headers = (("Content-Security-Policy", f"default-src 'none'; {styles}frame-ancestors 'none'"),)
    return Form(media_type, write, suffix, headers, compressed)


def _picture(name: str, subject: str) -> Computation:
    """A picture of the answer to an optimisation, drawn as the report draws it."""
    return Computation(
        name=f"picture_{name}",
        path=f"/v1/pictures/{name}",
        request="schemas.request.picture:PictureRequest",
        answer=None,
        compute=f"service.report.pictures:{name}",
        summary=f"{subject}, as SVG or PNG",
        remark="The header `Accept` chooses; `picture` says size, ground and title. "
        "With the counterweights that are found to be best, or those of the best compromise where none keep the "
        "ceilings.",
        tag="pictures",
        forms=(
            Form("image/svg+xml", "service.report.pictures:svg", ".svg"),
            Form("image/png", "service.report.pdf:png", ".png", compressed=True),
        ),
    )


def _table(name: str, subject: str) -> Computation:
    """A table of the answer to an optimisation, a number in every cell."""
    headers = (("Content-Disposition", f'attachment; filename="{name}.csv"'),)
    return Computation(
        name=f"table_{name}",
        path=f"/v1/tables/{name}",
        request="schemas.request.requests:OptimizeRequest",
        answer=None,
        compute=f"service.tables.tables:{name}",
        summary=f"{subject}, as CSV",
        remark="Of the answer to an optimisation; the first line holds the headings, with units.",
        tag="tables",
        forms=(Form("text/csv; charset=utf-8; header=present", "service.tables.lines:as_csv", ".csv", headers),),
    )


def _workbook(write: Reference, name: str) -> Form:
    """Request and answer as a workbook."""
    headers = (("Content-Disposition", f'attachment; filename="{name}"'),)
    return Form(XLSX, write, ".xlsx", headers, compressed=True, needs_request=True)


#: what a browser may take from a document as it stands
_STYLES = "img-src data:; style-src 'unsafe-inline'; "
COMPUTATIONS: dict[str, Computation] = {
    computation.name: computation
    for computation in (
        Computation(
            name="optimize",
            path="/v1/optimize",
            request="schemas.request.requests:OptimizeRequest",
            answer="schemas.answer.answers:OptimizeAnswer",
            compute="optimizer.optimize:optimize",
            summary="Counterweights that minimise the first-order peaks, with a certificate",
            remark="An infeasible machine is answered with 200 too: `status` says so, `infeasibility` says why.",
            help="Choose the counterweights of a machine.",
            chapters="service.report.chapters.answers:optimized",
            options=("outputs",),
            workbook="service.workbook.answers:answered",
            forms=(JSON, _workbook("service.workbook.answers:answered", "counterweights.xlsx")),
            later=True,
        ),
        Computation(
            name="analyze",
            path="/v1/analyze",
            request="schemas.request.requests:AnalyzeRequest",
            answer="schemas.answer.answers:AnalyzeAnswer",
            compute="optimizer.analyze:analyze",
            summary="Forces and moments of a machine as it stands, or with given counterweights",
            remark="`outputs` says what the answer shall hold; only the effects that they need are simulated.",
            help="Say what a machine does as it stands, or with given counterweights.",
            chapters="service.report.chapters.answers:analyzed",
            options=("outputs",),
        ),
        Computation(
            name="pareto",
            path="/v1/pareto",
            request="schemas.front.pareto:ParetoRequest",
            answer="schemas.front.pareto:ParetoAnswer",
            compute="optimizer.studies.pareto.pareto:pareto",
            summary="The certified trade-off of peak force, peak moment and total mass",
            remark="Every point is the lightest set of counterweights that no other set beats in both peaks, with a "
            "proof.",
            help="Trade peak force against peak moment: points that no counterweights beat in both.",
            chapters="service.report.chapters.pareto:traded",
            options=("points", "total_mass_budgets_kg"),
            long=True,
            later=True,
        ),
        Computation(
            name="accuracy",
            path="/v1/accuracy",
            request="schemas.request.accuracy:AccuracyRequest",
            answer="schemas.request.accuracy:AccuracyAnswer",
            compute="optimizer.studies.accuracy.measure:accuracy",
            summary="What accuracy costs in time on a machine: a ladder of methods and settings",
            remark="Times are those of this machine at this moment; errors and gaps do not depend on it.",
            help="Show what accuracy costs in time on a machine.",
            chapters="service.report.chapters.accuracy:ladders",
            options=("repeats",),
            picture="service.report.accuracy_picture:draw",
            long=True,
            later=True,
        ),
        Computation(
            name="pin_loads",
            path="/v1/scroll/pin-loads",
            request="schemas.scroll.pin_loads:PinLoadsRequest",
            answer="schemas.scroll.pin_loads:PinLoadsAnswer",
            compute="optimizer.pins.answer:pin_loads",
            summary="Loads of the anti-rotation pins of a scroll over a revolution",
            remark="Where the pins cannot hold the scroll at some angle, `equilibrium` and `dead_points_deg` say so.",
            help="Say what the anti-rotation pins of a scroll carry over a revolution.",
            chapters="service.report.chapters.pins:pins",
            tag="scroll",
            forms=(
                JSON,
                Form("text/csv", "service.tables.pins:pins_csv", ".csv"),
                Form("image/svg+xml", "service.report.pictures:pins_svg", ".svg"),
            ),
            examples="pin-loads",
        ),
        Computation(
            name="rating",
            path="/v1/rating",
            request="schemas.rating.request:RatingRequest",
            answer="schemas.rating.answer:RatingAnswer",
            compute="optimizer.rating.rate:rate",
            summary="Thermal design of a compressor: sizes, pressures, loads and powers",
            remark="Figures out of their customary range are answered with 200 too; `warnings` names them.",
            help="Size the cylinders of a compressor, and say what they deliver and need.",
            chapters="service.report.chapters.rating:rated",
            tag="rating",
            examples="rating",
        ),
        Computation(
            name="shaft",
            path="/v1/shaft",
            request="schemas.request.shaft:ShaftRequest",
            answer="schemas.answer.shaft:ShaftAnswer",
            compute="optimizer.mechanics.crankshaft.read:read_shaft",
            summary="The crankshaft that the faces and bodies of any CAD show",
            remark="Axis, frame, throws, webs and bearings from round and plane faces, unbalances in two planes from"
            " the masses of bodies. `doubts` holds what a designer should look at. A shaft with serious ones is"
            " answered with 200 too.",
            help="Read a crankshaft from the faces and bodies that a CAD lists.",
            chapters="service.report.chapters.shaft:shaft",
            tag="shaft",
            examples="shaft",
        ),
        Computation(
            name="match",
            path="/v1/match",
            request="schemas.match.request:MatchRequest",
            answer="schemas.match.answer:MatchAnswer",
            compute="optimizer.studies.matching.match:match",
            summary="Which weighed part goes on which row, each once, with a certificate",
            remark="Masses of parts are added to the reciprocating masses of the rows. An assignment that is not proven"
            " as closely as asked is answered with 200 too: `status` says so.",
            help="Say which weighed part goes on which row.",
            chapters="service.report.chapters.match:matched",
            examples="match",
            later=True,
        ),
        Computation(
            name="convert",
            path="/v1/convert",
            request="schemas.request.requests:OptimizeRequest",
            answer=None,
            compute="service.computations.computation:echo_request",
            summary="A request itself, checked: a workbook as JSON, or JSON as a workbook",
            remark="The header `Accept` chooses. Quantities come in the units of their fields, what was not given stays"
            " away, nothing is solved. What is wrong with a workbook is said with its cell.",
            tag="examples",
            workbook="service.workbook.answers:requested",
            forms=(
                Form("application/json", "service.computations.computation:request_bytes", ".json"),
                _workbook("service.workbook.answers:requested", "machine.xlsx"),
            ),
        ),
        Computation(
            name="round",
            path="/v1/round",
            request="schemas.request.rounding:RoundRequest",
            answer="schemas.request.rounding:RoundAnswer",
            compute="optimizer.studies.rounding.round:round_weights",
            summary="The best rounding of an optimum to steps of mass and angle, and what the steps cost",
            remark="Of every counterweight of the optimum mass and angle are on the step on either side, or it is left"
            " out; the certificate is of all these sets. `rounding` says what the steps cost.",
            help="Round an optimum to steps of mass and angle, and say what they cost.",
            chapters="service.report.chapters.rounding:with_rounding",
            options=("mass_step_kg", "angle_step_deg"),
            examples="round",
            later=True,
        ),
        # of answers
        Computation(
            name="verify",
            path="/v1/verify",
            request="schemas.request.verify:VerifyRequest",
            answer="schemas.request.verify:VerifyAnswer",
            compute="service.verification:verify",
            summary="Whether the claims of an answer hold, evaluated anew from request and answer alone",
            remark="Intervals of whole numbers enclose every rounding. A broken claim is answered with 200 too: "
            "`verdict` says so.",
            examples="verify",
            long=True,
        ),
        Computation(
            name="report",
            path="/v1/report",
            request="schemas.request.report:ReportRequest",
            answer=None,
            compute="service.report.document:report",
            summary="A document on a machine and its counterweights, as HTML or PDF",
            remark="The header `Accept` chooses; the eight stages are in it where the machine allows, other outputs as "
            "asked for.",
            forms=(
                _document(
                    ".html", "text/html", "service.report.html:html", "img-src data:; style-src 'unsafe-inline'; "
                ),
                _document(".pdf", "application/pdf", "service.report.pdf:pdf", compressed=True),
            ),
        ),
        Computation(
            name="drawings",
            path="/v1/drawings",
            request="schemas.request.drawings:DrawingsRequest",
            answer=None,
            compute="service.drawings.drawing_set:drawings",
            summary="Drawings of the counterweights for a workshop and for other CAD, in one zip file",
            remark="Of each part an outline (DXF), a sheet with dimensions (SVG) and a solid (STEP), all of them in"
            " their places, and the bill of material (CSV, xlsx). Webs with an envelope can be drawn.",
            forms=(
                Form(
                    "application/zip",
                    "service.drawings.archive:zipped",
                    ".zip",
                    (("Content-Disposition", 'attachment; filename="counterweights.zip"'),),
                    compressed=True,
                ),
            ),
            examples="drawings",
        ),
        Computation(
            name="layout",
            path="/v1/layout",
            request="schemas.request.layout:LayoutRequest",
            answer="schemas.request.layout:LayoutAnswer",
            compute="service.drawings.views:views",
            summary="The views of a machine as it is typed, from the front and from the side",
            remark="Nothing is solved. What is known of a half-typed machine is drawn, and `missing` names the fields"
            " that the rest needs.",
            tag="pictures",
        ),
        _table("built", "Counterweights as built beside the optimum, with the tolerance that they bear"),
        _table("order", "The order for a workshop: sizes, pieces, where each goes, and tolerances"),
        _table("foundation_loads", "Forces and couples on the foundation, order by order"),
        _table("pin_loads", "Load of every anti-rotation pin of a scroll over a revolution"),
        _picture("pin_loads", "The load of every anti-rotation pin of a scroll over a revolution"),
        _picture("front", "The machine from the front, with its counterweights"),
        _picture("side", "The machine from the side, with its counterweights"),
        _picture("force", "The hodograph of the first-order force, before and after"),
        _picture("moment", "The hodograph of the first-order moment, before and after"),
        _picture("bearings", "The loads of the main bearings as the shaft sees them, with their smallest circles"),
        _picture("indicator", "Indicator diagrams: pressure in the cylinders over the travel of the pistons"),
        _picture("stages", "The scheme of the eight balancing stages"),
        _picture("orders", "The hodographs of force and moment of every order"),
    )
}
