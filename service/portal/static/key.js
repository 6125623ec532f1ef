// The API key, kept for this tab only.

import { h } from "./dom.js";

const PLACE = "counterweight-key";
let asking = null;

export const key = () => sessionStorage.getItem(PLACE);

// Whether a key was given. Calls that are refused together ask once.
export function askKey(why) {
  asking ??= dialog(why).finally(() => { asking = null; });
  return asking;
}

function dialog(why) {
  const input = h("input", { id: "key", type: "password", autocomplete: "off", required: true });
  const box = h("dialog", { class: "key", "aria-labelledby": "key-title" },
    h("form", { method: "dialog" },
      h("h2", { id: "key-title" }, "This service asks for a key"),
      h("p", {}, why),
      h("label", { for: "key" }, "API key"), input,
      h("div", { class: "buttons" },
        h("button", { value: "use", class: "primary" }, "Use it in this tab"),
        h("button", { value: "", formnovalidate: true }, "Cancel"))));
  document.body.append(box);
  box.showModal();
  return new Promise((resolve) => {
    box.addEventListener("close", () => {
      const given = box.returnValue === "use" && input.value.trim();
      if (given) sessionStorage.setItem(PLACE, given);
      box.remove();
      resolve(Boolean(given));
    });
  });
}
