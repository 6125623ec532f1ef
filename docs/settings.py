"""Write the settings where operators read them, from the class that holds them: ``python docs/settings.py``."""

from collections.abc import Iterator
from pathlib import Path

from pydantic import AliasChoices
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from service.settings import Settings

ROOT = Path(__file__).parents[1]
GUIDE, EXAMPLE = ROOT / "docs" / "operation.md", ROOT / "deploy" / ".env.example"
BEGIN, END = "<!-- settings: written by docs/settings.py -->\n", "<!-- /settings -->\n"

#: what a default is that depends on the machine
MACHINE_DEPENDENT = {
    "concurrent_solves": "number of cores",
    "sweep_workers": "number of cores",
    "data_dir": "$XDG_DATA_HOME/counterweight",
    "guide_dir": "artefacts/site beside the packages",
}

#: what compose.yaml needs besides
COMPOSE = """
# ---- compose.yaml alone. It sets address, port, folder, keys, database and engine of the service itself.
# password of the database, which is made with it at the first start (required)
#POSTGRES_PASSWORD=
# where other machines reach the service, such as 0.0.0.0:8000 behind a proxy that speaks TLS
#COUNTERWEIGHT_PUBLISH=127.0.0.1:8000
# image, if it is not built here
#COUNTERWEIGHT_IMAGE=counterweight:latest
# most memory and processors of a container
#COUNTERWEIGHT_MEMORY=9g
#COUNTERWEIGHT_CPUS=2
# processes of the dask worker
#COUNTERWEIGHT_DASK_WORKERS=2
"""


def groups() -> Iterator[tuple[str, dict[str, FieldInfo]]]:
    """What a group of settings is about, and its settings by name."""
    for base in Settings.__bases__:
        yield (base.__doc__ or "").strip(), {name: Settings.model_fields[name] for name in base.__annotations__}


def variable(name: str, field: FieldInfo) -> str:
    """The environment variable of a setting."""
    if isinstance(field.validation_alias, AliasChoices):
        return str(field.validation_alias.choices[0])
    return f"COUNTERWEIGHT_{name.upper()}"


def default(name: str, field: FieldInfo) -> str:
    """A default as it is written in the environment, or in words if it is found at the start."""
    if field.default is PydanticUndefined:
        return MACHINE_DEPENDENT[name]
    match field.default:
        case None:
            return ""
        case bool(value):
            return str(value).lower()
        case tuple(values):
            return ",".join(values)
        case value:
            return str(value)


def table() -> str:
    """The settings in Markdown."""
    lines: list[str] = []
    for about, fields in groups():
        lines += [f"**{about}**", "", "| variable | default | meaning |", "|---|---|---|"]
        for name, field in fields.items():
            value = default(name, field)
            cell = value if name in MACHINE_DEPENDENT or not value else f"`{value}`"
            lines.append(f"| `{variable(name, field)}` | {cell} | {field.description} |")
        lines.append("")
    return "\n".join(lines)


def environment() -> str:
    """The settings as an environment file in which nothing is set."""
    lines = ["# Every setting of the service with its default. Copy to .env and take the # away from what you change."]
    for about, fields in groups():
        lines += ["", f"# ---- {about}"]
        for name, field in fields.items():
            value = default(name, field)
            lines.append(f"# {field.description}" + (f" (default: {value})" if name in MACHINE_DEPENDENT else ""))
            lines.append(f"#{variable(name, field)}={'' if name in MACHINE_DEPENDENT else value}")
    return "\n".join(lines) + "\n" + COMPOSE


def guide(text: str) -> str:
    """The operation guide with the table of today."""
    before, rest = text.split(BEGIN)
    return before + BEGIN + table() + END + rest.split(END)[1]


if __name__ == "__main__":
    GUIDE.write_text(guide(GUIDE.read_text("utf-8")), "utf-8")
    EXAMPLE.write_text(environment(), "utf-8")
