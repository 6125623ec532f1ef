// What stands in the place of an answer while there is none: ways to begin, those without gas data first.

import { h } from "./dom.js";
import { starter } from "./starter.js";

const SHOWN = 8;
const titled = ({ name, title }) => (title === name ? name : `${name}: ${title}`);

// the examples in the order in which one begins
export const inOrder = (examples) => [...examples].sort((one, other) => Number(one.gas) - Number(other.gas));

/** @param {any[]} examples @param {(request: any, example?: string) => void} begin gets what the questions make */
export const beginning = (examples, begin) => h("div", { class: "beginning" },
  h("h2", {}, "Begin with your machine"),
  h("ul", {},
    h("li", {}, "Paste it from a spreadsheet, anywhere on this page: tables of throws, rows and webs with their heads, one below the other or one by one."),
    h("li", {}, "Type it into the tables, or ", h("button", { type: "button", class: "small", click: () => starter(begin) }, "answer a few questions"), "."),
    h("li", {}, "Look at an example first: ",
      inOrder(examples).slice(0, SHOWN).map(({ name, title }, index) => [index ? ", " : "", h("a", { href: `#example=${name}` }, title)]), " and more above.")));

// the options of the list of examples
export const choices = (examples) => [h("option", { value: "" }, "(your own machine)"),
  ...[[false, "Masses alone"], [true, "With gas data"]].map(([gas, label]) => h("optgroup", { label },
    examples.filter((one) => one.gas === gas).map((one) => h("option", { value: one.name, title: one.description }, titled(one)))))];
