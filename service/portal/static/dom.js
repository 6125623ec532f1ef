// Elements from names, attributes and children. Texts become text nodes: nothing is ever read as markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value);
    else if (name === "dataset") Object.assign(element.dataset, value);
    else if (name === "value") element.value = value;
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export function h(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function s(tag, attributes, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

/** @type {(id: string) => any} an element of whatever kind the page has there */
export const byId = (id) => document.getElementById(id);

// with more columns each row becomes a card on a phone
const NARROW = 4;

export function table(caption, heads, rows) {
  const cell = (tag, content, attributes) =>
    h(tag, typeof content === "object" && content?.number ? { class: "number", ...attributes } : attributes,
      typeof content === "object" && content?.number ? content.text : content);
  return h("div", { class: "wide", tabindex: 0, role: "region", "aria-label": caption },
    h("table", { class: heads.length > NARROW ? "cards" : null },
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, heads.map((head) => cell("th", head, { scope: "col" })))),
      h("tbody", {}, rows.map((row) => h("tr", {},
        row.map((content, index) => cell(index ? "td" : "th", content, index ? { "data-head": heads[index] } : { scope: "row" })))))));
}
