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
  let now = CHOICES.includes(localStorage.getItem(PLACE)) ? localStorage.getItem(PLACE) : "auto";
  apply(now);
  button.addEventListener("click", () => {
    now = CHOICES[(CHOICES.indexOf(now) + 1) % CHOICES.length];
    localStorage.setItem(PLACE, now);
    apply(now);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
}
