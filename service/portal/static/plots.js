// Plots, with the library loaded when the first one is drawn.

const drawn = new Map();
let library = null;

export function load() {
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

// The plot of `make()`: {traces, layout, label, click}. It is asked again when the colours change.
export async function plot(node, make) {
  node.classList.add("plot");
  drawn.set(node, make);
  const plotly = await load();
  const { traces, layout = {}, label, click } = make();
  const ink = variable("ink");
  const grid = variable("grid");
  const { xaxis, yaxis, ...rest } = layout;
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

export async function recolour() {
  for (const [node, make] of drawn) {
    if (!node.isConnected) drawn.delete(node);
    else if (node.offsetParent) await plot(node, make);
  }
}

// on paper plots are scaled to their column, as pictures are
const pictures = () => document.querySelectorAll(".plot .main-svg");
addEventListener("beforeprint", () => {
  for (const one of pictures()) one.setAttribute("viewBox", `0 0 ${one.getAttribute("width")} ${one.getAttribute("height")}`);
});
addEventListener("afterprint", () => {
  for (const one of pictures()) one.removeAttribute("viewBox");
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
