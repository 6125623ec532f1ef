"""What the site of the documents holds beside this folder: pages and files of the tree that documents link to."""

import re
from pathlib import Path, PurePosixPath
from posixpath import normpath, relpath

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[1]
#: pages beside the folder, by their place in the site
PAGES = {"index.md": "README.md", "CHANGELOG.md": "CHANGELOG.md", "CONTRIBUTING.md": "CONTRIBUTING.md"}
#: where other files of the tree stand in the site
TREE = "tree"
_LINK = re.compile(r"\]\((?!\w+:|#)([^)#\s]+)(#[^)\s]*)?\)")


def source(page: str) -> PurePosixPath:
    """Path in the tree of a page of the site."""
    return PurePosixPath(PAGES[page]) if page in PAGES else PurePosixPath("docs", page)


def place(path: str) -> str | None:
    """Path in the site of a file of the tree; None for a folder, which has no page."""
    for page, file in PAGES.items():
        if path == file:
            return page
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    return f"{TREE}/{path}" if (ROOT / path).is_file() else None


def linked(text: str, page: str) -> list[str]:
    """Paths in the tree of what a page of the site links to."""
    return [normpath(str(source(page).parent / match[1])) for match in _LINK.finditer(text)]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages beside the folder, and the files of the tree that any page links to."""
    for page, file in PAGES.items():
        files.append(File.generated(config, page, content=(ROOT / file).read_text()))
    for page in [file for file in files if file.is_documentation_page()]:
        for path in linked(page.content_string, page.src_uri):
            where = place(path)
            if where is not None and where.startswith(f"{TREE}/") and files.get_file_from_path(f"{where}.txt") is None:
                # as text: a browser shows it, and no page of the site is made of it
                files.append(File.generated(config, f"{where}.txt", content=(ROOT / path).read_text()))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Lead links of the tree to their places in the site; a folder of the tree keeps its name alone."""
    here = page.file.src_uri

    def led(match: re.Match[str]) -> str:
        where = place(normpath(str(source(here).parent / match[1])))
        if where is None:
            return "]"
        where = f"{where}.txt" if where.startswith(f"{TREE}/") else where
        return f"]({relpath(where, str(PurePosixPath(here).parent))}{match[2] or ''})"

    return _LINK.sub(led, markdown)
