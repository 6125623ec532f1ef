"""Modules joined to one file: what each sees of the others, and what is refused. Needs no browser."""

import re
from pathlib import Path

import pytest

from service.portal.bundle import CircularImport, UnknownStatement, bundle


def _written(folder: Path, **modules: str) -> Path:
    for name, text in modules.items():
        path = folder / name.replace("__", "/")
        path.parent.mkdir(exist_ok=True)
        path.with_suffix(".js").write_text(text)
    return folder


def test_modules_stand_after_what_they_need_once_each(tmp_path: Path) -> None:
    folder = _written(
        tmp_path,
        main='import { b as other } from "./in/b.js";\nimport { a } from "./a.js";\nother(a);\n',
        a="export const a = 1;\nexport class C {}\nexport async function* f() {}\n",
        in__b='import { a } from "../a.js";\nexport function b() { return a; }\n',
    )
    text = bundle(folder, "main.js")
    assert re.findall("^// (.*)$", text, re.MULTILINE) == ["a.js", "in/b.js", "main.js"]
    assert re.findall("^const {.*|^return .*", text, re.MULTILINE) == [
        "return { a, C, f };",
        "const { a } = module0;",
        "return { b };",
        "const { b: other } = module1;",
        "const { a } = module0;",
        "return {  };",
    ]
    assert not re.search("export|import", text)


def test_comments_stay_in_the_folder(tmp_path: Path) -> None:
    notes = "// why\n/** @type {a} */\n", "/**\n * more\n * @param b\n */\n  // within\n"
    text = f'{notes[0]}const a = "// no comment";\n{notes[1]}const c = 1 / 2;\n'
    assert bundle(_written(tmp_path, main=text), "main.js").splitlines()[2:4] == [
        'const a = "// no comment";',
        "const c = 1 / 2;",
    ]


@pytest.mark.parametrize(
    "statement",
    [
        'import * as all from "./a.js";',
        'import "./a.js";',
        'import {\n  a,\n} from "./a.js";',
        'import { a } from "https://elsewhere.example/a.js";',
        "export default 1;",
        "export { a };",
        "export let a = 1;",
        'const a = await import("./a.js");',
    ],
)
def test_what_is_not_understood_is_refused(tmp_path: Path, statement: str) -> None:
    with pytest.raises(UnknownStatement, match=r"main\.js"):
        bundle(_written(tmp_path, main=statement, a="export const a = 1;\n"), "main.js")


def test_modules_that_need_one_another_are_refused(tmp_path: Path) -> None:
    folder = _written(
        tmp_path,
        main='import { a } from "./a.js";\n',
        a='import { b } from "./b.js";\nexport const a = b;\n',
        b='import { a } from "./a.js";\nexport const b = a;\n',
    )
    with pytest.raises(CircularImport, match=r"a\.js needs b\.js needs a\.js"):
        bundle(folder, "main.js")
