"""What a user does with the page, counted: fields and pastes, and clicks."""

from dataclasses import dataclass

from tests.browser.portal import Portal


@dataclass
class Hand:
    """Counts what a user does."""

    portal: Portal
    fields: int = 0
    clicks: int = 0

    @property
    def count(self) -> int:
        return self.fields + self.clicks

    def click(self, selector: str) -> None:
        self.clicks += 1
        self.portal.page.locator(selector).first.click()

    def fill(self, selector: str, value: str) -> None:
        self.fields += 1
        field = self.portal.page.locator(selector)
        if field.evaluate("node => node.tagName") == "SELECT":
            field.select_option(value)
        else:
            field.fill(value)

    def cell(self, pointer: str, value: str) -> None:
        self.fields += 1
        self.portal.input(pointer).fill(value)

    def paste(self, grid: str, text: str) -> None:
        self.drop(f"#form .grid-{grid} .wide", text)

    def drop(self, selector: str, text: str) -> None:
        self.fields += 1
        self.portal.paste(selector, text)

    def answer(self, values: dict[str, str]) -> None:
        """Questions of a new machine."""
        for name, value in values.items():
            self.fill(f"#start-{name}", value)
