// Which fields vary, and over which values.

import { h } from "../dom.js";
import { read } from "../quantity.js";
import { around } from "./numbers.js";

const MOST = 4;

export class Axes {
  // `numbers` are the fields there are, `given` the axes to start from
  constructor(numbers, given) {
    this.numbers = numbers;
    this.axes = given;
    this.element = h("div", { class: "axes" });
    this.draw();
  }

  // what engineers ask first: the moving masses, then the room for counterweights
  static usual(numbers) {
    const likely = [/reciprocating_mass_kg$|orbiting_mass_kg$/, /max_mass_kg$/, /speed_rpm$/];
    const known = likely.flatMap((pattern) => numbers.filter(({ pointer }) => pattern.test(pointer)));
    return [...new Set([...known, ...numbers])].slice(0, 2).map((one) => Axes.over(one));
  }

  static over({ pointer, value }) {
    const [start, stop] = around(value);
    return { path: pointer, start, stop, count: "15" };
  }

  // as the service takes them
  value(counted) {
    return this.axes.map(({ path, start, stop, count }) => ({ path, start: read(start), stop: read(stop), ...(counted ? { count: read(count) } : {}) }));
  }

  draw() {
    const unused = () => this.numbers.find(({ pointer }) => !this.axes.some((axis) => axis.path === pointer));
    this.element.replaceChildren(
      ...this.axes.map((axis, index) => this.row(axis, index)),
      this.axes.length < MOST && unused()
        ? h("button", { type: "button", click: () => { this.axes.push(Axes.over(unused())); this.draw(); } }, "Add a field") : "");
  }

  row(axis, index) {
    const input = (name, title) => h("div", { class: "field", dataset: { pointer: `/axes/${index}/${name}` } },
      h("label", { for: `axis-${index}-${name}` }, title),
      h("input", { id: `axis-${index}-${name}`, type: "text", autocomplete: "off", value: axis[name], input: (event) => { axis[name] = event.target.value; } }),
      h("p", { class: "error" }));
    const select = h("select", { id: `axis-${index}-path`, change: () => {
      Object.assign(axis, Axes.over(this.numbers.find(({ pointer }) => pointer === select.value)));
      this.draw();
    } }, this.numbers.map(({ pointer, name, unit }) => h("option", { value: pointer }, `${name}${unit ? `, ${unit}` : ""}`)));
    select.value = axis.path;
    return h("fieldset", { class: "axis", dataset: { pointer: `/axes/${index}` } },
      h("legend", {}, `Field ${index + 1}`),
      h("div", { class: "field wider", dataset: { pointer: `/axes/${index}/path` } }, h("label", { for: `axis-${index}-path` }, "what varies"), select, h("p", { class: "error" })),
      input("start", "from"), input("stop", "to"), input("count", "values"),
      this.axes.length > 1 ? h("button", { type: "button", class: "small", click: () => { this.axes.splice(index, 1); this.draw(); } }, "Remove") : null,
      h("p", { class: "error" }));
  }
}
