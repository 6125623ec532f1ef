// The table of the form that a pasted text belongs to, by its heads.

import { cellsOf, knownHeads, numeric } from "./paste.js";

const LISTS = ["/machine/throws", "/machine/webs", "/machine/bearings", "/fitted"];
const FEWEST_HEADS = 2;

function grids(form) {
  form.group("/machine")?.build();
  for (const list of LISTS) form.group(list)?.build?.();
  return LISTS.flatMap((list) => form.gridsOf(list));
}

// The table that knows most of the heads; of several the one of the title, or that needs nothing else. None that knows one only.
export function home(form, heads, title = "") {
  const words = title.toLowerCase();
  const fits = grids(form).map((grid) => ({ grid, named: Number(words.includes(grid.table.item)), ...grid.pasting.fit(heads) })).filter((fit) => fit.heads >= FEWEST_HEADS);
  return fits.sort((one, other) => other.heads - one.heads || other.named - one.named || one.missing - other.missing)[0]?.grid ?? null;
}

// the table that knows more of the heads than the one where a text was pasted
export function elsewhere(grid, text) {
  const [heads] = cellsOf(text);
  if (heads.some(numeric)) return null;
  const other = home(grid.form, heads);
  return other && other.pasting.fit(heads).heads > knownHeads(heads, grid.pasting.pasteable()).size ? other : null;
}

// the number of lines that went into a table, which is opened
export function moved({ form, table, source }, text) {
  form.opened(source.pointer);
  const now = form.gridsOf(source.pointer).find((one) => one.table === table);
  const count = now.pasting.fill(text, 0, 0, {});
  form.container.querySelector(`.grid-${table.item}`)?.scrollIntoView({ block: "nearest" });
  return count;
}
