// The numbers of a request that a sweep can vary.

import { called } from "../naming.js";
import { get, join } from "../pointer.js";

const ROOTS = ["machine", "objective"];

// [{pointer, name, unit, value}] of all numbers that the request holds
export function numbersOf(request, schema, model) {
  const found = [];
  const visit = (description, pointer) => {
    const value = get(request, pointer);
    if (value === undefined || value === null) return;
    if (description.kind === "number") found.push({ pointer, unit: description.unit, value, name: called(request, pointer) });
    if (description.kind === "variants" && typeof value !== "object") {
      found.push({ pointer, unit: description.unit, value, name: called(request, pointer) });
    }
    if (description.kind === "list") value.forEach((_, index) => visit(description.items, join(pointer, index)));
    const object = description.kind === "union" ? description.options.get(value[description.tag]) : description;
    for (const [name, node] of Object.entries(object?.properties ?? {})) visit(schema.describe(node), join(pointer, name));
  };
  const root = schema.model(model);
  for (const name of ROOTS) visit(schema.describe(root.properties[name]), `/${name}`);
  return found;
}

const QUANTITY = /^\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*(.*?)\s*$/;

// A range around a value, in the value's own unit.
export function around(value) {
  const [, digits, unit] = QUANTITY.exec(String(value)) ?? [null, "1", ""];
  const number = Number(digits);
  const [low, high] = number === 0 ? [-1, 1] : [0.8 * number, 1.2 * number].sort((one, other) => one - other);
  const write = (bound) => `${Number(bound.toPrecision(6))}${unit ? ` ${unit}` : ""}`;
  return [write(low), write(high)];
}
