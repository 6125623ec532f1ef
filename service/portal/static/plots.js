// Plots, with the library loaded when the first one is drawn. They are drawn one a frame, those in view first and the
// others when nobody needs the page: what is clicked or typed waits for one of them at most.

import { h } from "./dom.js";
import { painted, spared } from "./later.js";

/** @type {Map<HTMLElement, () => any>} what every plot is made of */
const drawn = new Map();
/** @type {Map<HTMLElement, { done: ((value?: any) => void)[], failed: ((error: Error) => void)[] }>} those that wait for their turn */
const due = new Map();
let library = null;
let busy = false;

function load() {
  library ??= new Promise((resolve, reject) => {
    // The library writes style attributes, which the policy of this page forbids; the same through the object
    // model is allowed, and does not loosen the policy.
    const write = Element.prototype.setAttribute;
    /** @this {HTMLElement | SVGElement} */
    Element.prototype.setAttribute = function setAttribute(name, value) {
      if (name === "style") this.style.cssText = value;
      else write.call(this, name, value);
    };
    // Nor is the stylesheet of its maps allowed, of which there are none here.
    const append = document.head.appendChild;
    document.head.appendChild = (/** @type {any} */ node) => (node.tagName === "STYLE" && node.textContent ? node : append.call(document.head, node));
    const script = document.createElement("script");
    script.src = new URL("plotly.min.js", import.meta.url).href;
    script.onload = () => { Reflect.deleteProperty(document.head, "appendChild"); resolve(Reflect.get(globalThis, "Plotly")); };
    script.onerror = () => { library = null; reject(new Error("The plotting library did not arrive.")); };
    document.head.append(script);
  });
  return library;
}

const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// Colours that colour-blind people tell apart (Okabe and Ito); dashes and symbols repeat what colours say.
export const colours = () => ({
  before: variable("before"), after: variable("after"), floor: variable("ink"), mark: variable("mark"),
  series: [1, 2, 3, 4, 5, 6, 7].map((number) => variable(`series-${number}`)),
});
export const DASHES = ["solid", "dash", "dot", "dashdot", "longdash", "longdashdot"];
export const series = (index) => {
  const all = colours().series;
  return { color: all[index % all.length], dash: DASHES[Math.floor(index / all.length + index) % DASHES.length] };
};

const axis = (given, ink, grid) => ({
  gridcolor: grid, zerolinecolor: grid, linecolor: grid, exponentformat: "SI", ...given,
  title: { text: given?.title ?? "", standoff: 6 }, color: ink,
});

// Where the plots of a panel stand: those that are there already are changed, which is quicker than to make them anew.
export function places(body, count) {
  const there = body.querySelectorAll(".plot");
  return Array.from({ length: count }, (_, index) => there[index] ?? h("div"));
}

// The plot of `make()`: {traces, layout, label, click}. It is asked again when the colours change. Resolves when it is drawn.
export function plot(node, make) {
  node.classList.add("plot");
  node.setAttribute("aria-busy", "true");
  drawn.set(node, make);
  return new Promise((resolve, reject) => {
    const waiting = due.get(node) ?? { done: [], failed: [] };
    waiting.done.push(resolve);
    waiting.failed.push(reject);
    due.set(node, waiting);
    turns();
  });
}

const seen = (node) => {
  const { top, bottom, width } = node.getBoundingClientRect();
  return width > 0 && bottom > 0 && top < innerHeight;
};

async function turns() {
  if (busy) return;
  busy = true;
  while (due.size) {
    await painted();
    let next = [...due.keys()].find(seen);
    if (!next) {
      await spared();
      next = [...due.keys()].find(seen) ?? due.keys().next().value;
    }
    const plotly = await load().catch((error) => error);
    if (next) await take(plotly, next);
  }
  busy = false;
}

// one that is no longer there counts as drawn
async function take(plotly, node) {
  const waiting = due.get(node);
  if (!waiting) return;
  due.delete(node);
  try {
    if (plotly instanceof Error) throw plotly;
    if (node.isConnected) await draw(plotly, node, /** @type {any} */ (drawn.get(node))());
    if (!due.has(node)) node.removeAttribute("aria-busy");
    for (const done of waiting.done) done();
  } catch (error) {
    for (const failed of waiting.failed) failed(error);
  }
}

/** @param {any} plotly @param {any} node @param {{ traces: object[], layout?: any, label: string, click?: (point: any) => void }} picture */
async function draw(plotly, node, picture) {
  const { traces, layout, label, click } = picture;
  const ink = variable("ink");
  const grid = variable("grid");
  const { xaxis, yaxis, ...rest } = layout ?? {};
  node.setAttribute("role", "img");
  node.setAttribute("aria-label", label);
  await plotly.react(node, traces, {
    height: 300, margin: { l: 68, r: 14, t: 34, b: 46 }, paper_bgcolor: "transparent", plot_bgcolor: "transparent",
    font: { color: ink, family: "system-ui, sans-serif", size: 12 }, hovermode: "closest", dragmode: "zoom",
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0 },
    xaxis: axis(xaxis, ink, grid), yaxis: axis(yaxis, ink, grid), ...rest,
  }, { displayModeBar: false, responsive: true, logging: 0 });
  node.removeAllListeners?.("plotly_click");
  if (click) node.on("plotly_click", ({ points }) => click(points[0]));
}

export function recolour() {
  for (const [node, make] of drawn) {
    if (!node.isConnected) drawn.delete(node);
    else if (node.offsetParent) plot(node, make);
  }
}

// on paper plots are scaled to their column, as pictures are; none of them may still wait for its turn
const pictures = () => document.querySelectorAll(".plot .main-svg");
addEventListener("beforeprint", () => {
  const plotly = Reflect.get(globalThis, "Plotly");
  document.documentElement.dataset.paper = "";
  if (plotly) {
    for (const node of [...due.keys()]) take(plotly, node);
    for (const [node, make] of drawn) if (node.isConnected && node.offsetParent) draw(plotly, node, /** @type {any} */ (make()));
  }
  for (const one of pictures()) one.setAttribute("viewBox", `0 0 ${one.getAttribute("width")} ${one.getAttribute("height")}`);
});
addEventListener("afterprint", () => {
  delete document.documentElement.dataset.paper;
  for (const one of pictures()) one.removeAttribute("viewBox");
  recolour();
});

// one turn is a closed line, or two where gas takes two
export const closed = (values) => [...values, values[0]];
const end = (angles) => 360 * (Math.floor((angles.at(-1) ?? 0) / 360) + 1);
export const turn = (angles) => [...angles, end(angles)];
export const overTurn = (title, angles, range) => ({
  xaxis: { title: "shaft angle, deg", range: [0, end(angles)], tickvals: [0, 1, 2, 3, 4, 5, 6].map((part) => (part * end(angles)) / 6) },
  yaxis: { title, ...range },
});
export const line = (angles, values, name, style) => ({
  x: turn(angles), y: closed(values), name, mode: "lines", line: { width: 2, ...style },
  hovertemplate: `%{x:.0f}°: %{y:.5~s}<extra>${name.replaceAll("<", "&lt;")}</extra>`,
});
