// Light, dark, or as the system has it.

import { recolour } from "./plots.js";

const PLACE = "counterweight-theme";
const CHOICES = ["auto", "light", "dark"];

export function theme(button) {
  const apply = (chosen) => {
    if (chosen === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = chosen;
    button.textContent = `Theme: ${chosen}`;
    recolour();
  };
  const kept = localStorage.getItem(PLACE);
  let now = kept !== null && CHOICES.includes(kept) ? kept : "auto";
  apply(now);
  button.addEventListener("click", () => {
    now = CHOICES[(CHOICES.indexOf(now) + 1) % CHOICES.length];
    localStorage.setItem(PLACE, now);
    apply(now);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
}
