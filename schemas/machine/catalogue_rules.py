"""Rules between a catalogue and its webs."""

from collections.abc import Iterator, Sequence

from schemas.base.rules import Path, Rule
from schemas.machine.catalogue import Catalogue
from schemas.machine.choices import KINDS, own_options, stated
from schemas.machine.webs import Web

#: masses times angles of one web, and of all webs together
MAX_OPTIONS, MAX_OPTIONS_TOGETHER = 20_000, 200_000


def catalogue_rules(catalogue: Catalogue, webs: Sequence[tuple[Path, Web]]) -> Iterator[Rule]:
    """What the discrete choices of a machine have to hold, of webs with their paths; paths from the machine."""
    together, step_kg = 0, catalogue.mass_step_kg
    # of the webs that count by it
    largest = [web.max_mass_kg for _, web in webs if web.fixed is None and web.catalogue_masses_kg is None]
    if step_kg is not None and largest:
        most = max(limit or 0.0 for limit in largest)
        message = f"larger than the largest mass of every web, {most:g} kg: nothing could be fitted"
        yield Rule(None not in largest and 0.0 < most * (1.0 + 1e-12) < step_kg, ("catalogue", "mass_step_kg"), message)
    for place, web in webs:
        if web.fixed is not None:
            continue
        for name in stated(web):
            for broken, path, message in KINDS[name].rules(getattr(web, name), web):
                yield Rule(broken, (*place, *path), message)
        own = own_options(web)
        if own.pairs is not None:
            options = len(own.pairs)
        else:
            step = catalogue.mass_step_kg if own.masses is None else None
            no_masses = own.masses is None and catalogue.masses_kg is None and step is None
            message = "the catalogue has no masses for this web: give them here, or for all webs in `catalogue`"
            yield Rule(no_masses, (*place, "catalogue_masses_kg"), message)
            no_angles = own.angles is None and catalogue.angle_step_deg is None
            message = "the catalogue has no angles for this web: give its holes, or `catalogue.angle_step_deg`"
            yield Rule(no_angles, (*place, "hole_angles_deg"), message)
            endless = step is not None and web.max_mass_kg is None
            yield Rule(endless, (*place, "max_mass_kg"), "`mass_step_kg` needs a largest mass of this web")
            if no_masses or no_angles or endless:
                continue
            masses = len(own.masses or catalogue.masses_kg or ())
            if step is not None:
                masses = int(min((web.max_mass_kg or 0.0) / step, 1e9))
            options = masses * (len(own.angles or ()) or round(360 / (catalogue.angle_step_deg or 360)))
        together += options
        message = f"masses times angles of a web must be at most {MAX_OPTIONS}"
        yield Rule(options > MAX_OPTIONS, place, message)
    message = f"masses times angles of all webs together must be at most {MAX_OPTIONS_TOGETHER}"
    yield Rule(together > MAX_OPTIONS_TOGETHER, ("webs",), message)
