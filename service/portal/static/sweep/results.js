// The rows of a sweep as a heat map or as points, and as files.

import { address, ask } from "../api.js";
import { h } from "../dom.js";
import { save as saveFile } from "../files.js";
import { figure } from "../format.js";
import { key } from "../key.js";
import { colours, plot } from "../plots.js";

const MOST_ROWS = 20_000;
const FORMATS = ["csv", "xlsx", "ndjson", "parquet", "arrow"];
const RANKED = ["force_peak_N", "moment_peak_Nm", "total_mass_kg", "relative_gap"];
const WORDS = { force_peak_N: "peak force, N", moment_peak_Nm: "peak moment, N m", total_mass_kg: "total mass, kg", relative_gap: "relative gap" };

export async function rowsOf(id, signal) {
  const text = await (await ask("GET", `v1/sweeps/${id}/results?format=ndjson&limit=${MOST_ROWS}`, { signal })).text();
  return text.split("\n").filter(Boolean).map((line) => JSON.parse(line));
}

export function downloads(id) {
  const save = async (event, format) => {
    // a link cannot carry a key
    if (!key()) return;
    event.preventDefault();
    saveFile(await (await ask("GET", `v1/sweeps/${id}/results?format=${format}`)).blob(), `sweep.${format}`);
  };
  return h("p", { class: "downloads" }, "Download all rows: ", FORMATS.map((format) => [
    h("a", { href: address(`v1/sweeps/${id}/results?format=${format}`), download: `sweep.${format}`, click: (event) => save(event, format) }, format), " "]));
}

// `axes` are {path, name, unit}; `grid` says whether every combination was computed
export async function showRows(place, rows, axes, grid, total) {
  const good = rows.filter((row) => typeof row.force_peak_N === "number");
  if (!good.length) {
    place.replaceChildren(h("p", {}, `No design has an answer: ${rows[0]?.message ?? rows[0]?.status ?? "there are no rows"}.`));
    return;
  }
  const choices = [...RANKED, ...Object.keys(good[0]).filter((name) => name.startsWith("mass_kg.") || name.startsWith("angle_deg."))];
  const said = (name) => WORDS[name] ?? axes.find((axis) => axis.path === name)?.title ?? name;
  const select = (id, options, chosen) => {
    const made = h("select", { id, change: () => draw() }, options.map((name) => h("option", { value: name }, said(name))));
    made.value = chosen;
    return made;
  };
  const shown = select("sweep-shown", choices, "force_peak_N");
  const form = h("select", { id: "sweep-form", change: () => draw() }, (grid && axes.length === 2 ? ["heat map", "points"] : ["points"]).map((name) => h("option", {}, name)));
  const across = select("sweep-across", [...axes.map((axis) => axis.path), ...RANKED], axes[0].path);
  const upward = select("sweep-upward", [...axes.map((axis) => axis.path), ...RANKED], axes[1]?.path ?? "force_peak_N");
  const node = h("div");
  const control = (name, input) => h("div", { class: "choose" }, h("label", { for: input.id }, name), input);
  const draw = () => plot(node, () => (form.value === "heat map" ? heatMap(good, across.value, upward.value, shown.value, said)
    : scatter(good, across.value, upward.value, shown.value, said)));
  place.replaceChildren(h("div", { class: "controls" }, control("Show", shown), control("as", form), control("across", across), control("upward", upward)), node,
    h("p", { class: "about" }, `${figure(good.length)} of ${figure(total)} designs are drawn${rows.length > good.length ? `; ${rows.length - good.length} have no answer` : ""}.`));
  await draw();
}

function heatMap(rows, across, upward, shown, said) {
  const levels = (name) => [...new Set(rows.map((row) => row[name]))].sort((one, other) => one - other);
  const [xs, ys] = [levels(across), levels(upward)];
  const at = new Map(rows.map((row) => [`${row[across]} ${row[upward]}`, row[shown]]));
  return {
    traces: [{ type: "heatmap", x: xs, y: ys, z: ys.map((y) => xs.map((x) => at.get(`${x} ${y}`) ?? null)), colorscale: "Cividis", zsmooth: false,
      colorbar: { title: { text: said(shown), side: "right" }, thickness: 14, exponentformat: "SI" }, hovertemplate: "%{x:.5~s}, %{y:.5~s}: %{z:.5~s}<extra></extra>" }],
    layout: { height: 380, xaxis: { title: said(across) }, yaxis: { title: said(upward) } },
    label: `Heat map of ${said(shown)}, from ${spread(rows, shown)}.`,
  };
}

function scatter(rows, across, upward, shown, said) {
  const of = (name) => rows.map((row) => row[name]);
  return {
    traces: [{ type: rows.length > 4000 ? "scattergl" : "scatter", mode: "markers", x: of(across), y: of(upward),
      marker: { color: of(shown), colorscale: "Cividis", size: 6, showscale: true, line: { width: 0.5, color: colours().floor },
        colorbar: { title: { text: said(shown), side: "right" }, thickness: 14, exponentformat: "SI" } },
      customdata: of(shown), hovertemplate: "%{x:.5~s}, %{y:.5~s}: %{customdata:.5~s}<extra></extra>" }],
    layout: { height: 380, xaxis: { title: said(across) }, yaxis: { title: said(upward) } },
    label: `${rows.length} designs; ${said(shown)} from ${spread(rows, shown)}.`,
  };
}

function spread(rows, name) {
  const [low, high] = rows.reduce(([least, most], row) => [Math.min(least, row[name]), Math.max(most, row[name])], [Infinity, -Infinity]);
  return `${figure(low)} to ${figure(high)}`;
}
