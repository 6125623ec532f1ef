// Text for the clipboard, or to be copied by hand where there is none.

import { h } from "../dom.js";

export async function copied(text, said) {
  const done = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  if (done) {
    said.replaceChildren(h("p", {}, "Copied: paste it into a spreadsheet."));
    return;
  }
  const area = h("textarea", { rows: 8, readonly: true, "aria-label": "the table as text", value: text });
  said.replaceChildren(h("p", {}, "Copy it with the keyboard:"), area);
  area.select();
}
