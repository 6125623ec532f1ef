// What a field takes, from the schemas that the OpenAPI document holds too: those of the form alone come with the page.

import { get } from "./api.js";

export const schemas = async () => new Schema(await get(new URL("schemas.json", import.meta.url).href));

export class Schema {
  constructor(known) {
    this.known = known;
  }

  deref(node) {
    if (!node.$ref) return node;
    const { $ref, ...own } = node;
    return { ...this.deref(this.known[$ref.split("/").pop()]), ...own };
  }

  model(name) {
    return this.describe({ $ref: `#/components/schemas/${name}` });
  }

  // all alternatives, however deep they are nested
  alternatives(node) {
    const found = this.deref(node);
    const options = found.anyOf ?? found.oneOf;
    if (options) return options.flatMap((option) => this.alternatives(option));
    // plain values of several types are one schema with a list of types
    return [found.type].flat().map((type) => ({ ...found, type }));
  }

  // {kind, about, unit, nullable, fallback, example, ...}: kind is one of
  // number, text, boolean, choice, constant, object, union, list, numbers, variants
  describe(node) {
    const found = this.deref(node);
    const all = this.alternatives(node);
    const about = {
      about: found.description ?? "",
      title: found.title, group: found["x-group"], unit: found["x-unit"],
      nullable: all.some((one) => one.type === "null"),
      fallback: found.default,
      example: found.examples?.[0],
    };
    const given = all.filter((one) => one.type !== "null");
    const objects = given.filter((one) => one.properties);
    const numeric = given.find((one) => one.type === "number" || one.type === "integer");
    const choice = given.find((one) => one.enum);
    const list = given.find((one) => one.type === "array");
    if (objects.length > 1) return { ...about, kind: "union", ...this.union(objects) };
    if (objects.length && numeric) return { ...about, kind: "variants", object: this.object(objects[0]) };
    if (objects.length) return { ...about, kind: "object", ...this.object(objects[0]) };
    if (list) return { ...about, ...this.list(list) };
    if (given.some((one) => "const" in one)) return { ...about, kind: "constant", value: given[0].const };
    if (choice) return { ...about, kind: "choice", options: choice.enum.filter((one) => one !== null) };
    if (numeric) return { ...about, kind: "number", text: given.some((one) => one.type === "string"), ...range(numeric) };
    if (given.some((one) => one.type === "boolean")) return { ...about, kind: "boolean" };
    return { ...about, kind: "text", longest: given[0]?.maxLength };
  }

  // what stands at a place of a request (parts of a pointer), null where nothing may
  at(description, value, parts) {
    const [first, ...rest] = parts;
    const shape = description.kind === "union" ? description.options.get(value?.[description.tag]) ?? [...description.options.values()][0]
      : description.object ?? description;
    if (first === undefined) return shape;
    if (shape.kind === "list") return this.at(shape.items, value?.[first], rest);
    return shape.properties?.[first] ? this.at(this.describe(shape.properties[first]), value?.[first], rest) : null;
  }

  // what a list of names may hold
  options(model, name) {
    const list = this.alternatives(this.known[model].properties[name]).find((one) => one.type === "array");
    return this.deref(list.items).enum;
  }

  namesAt(description, value, parts) {
    return Object.keys(this.at(description, value, parts)?.properties ?? {});
  }

  object(node) {
    // of fields that go together those that are usual
    return { properties: ordered(node.properties), required: new Set([...(node.required ?? []), ...(node.then?.required ?? [])]) };
  }

  union(objects) {
    const tag = Object.keys(objects[0].properties).find((name) => "const" in objects[0].properties[name]) ?? "";
    return { tag, options: new Map(objects.map((one) => [one.properties[tag].const, this.object(one)])) };
  }

  list(node) {
    const items = this.describe(node.items);
    return items.kind === "number" ? { kind: "numbers", items } : { kind: "list", items, most: node.maxItems ?? Infinity };
  }

  // what a new thing holds before anybody has typed: its kind and empty lists, undefined where there is nothing to hold
  blank(description) {
    const { kind } = description;
    if (kind === "constant") return description.value;
    if (kind === "list") return [];
    if (kind === "union") return {};
    return kind === "object" ? this.filled(description) : undefined;
  }

  // a required choice of several kinds is the reader's
  filled({ properties, required }) {
    const made = Object.entries(properties).filter(([name]) => required.has(name)).map(([name, node]) => [name, this.describe(node)])
      .filter(([, description]) => description.kind !== "union").map(([name, description]) => [name, this.blank(description)]);
    return Object.fromEntries(made.filter(([, value]) => value !== undefined));
  }
}

const ordered = (properties) => Object.fromEntries(Object.entries(properties).sort(([, one], [, other]) => (one["x-order"] ?? 0) - (other["x-order"] ?? 0)));

function range(node) {
  return {
    lowest: node.minimum ?? node.exclusiveMinimum,
    highest: node.maximum ?? node.exclusiveMaximum,
    whole: node.type === "integer",
  };
}

// a new item beside others is like the last one, under a name that is free
export function another(items) {
  const made = structuredClone(items.at(-1));
  if (typeof made?.name !== "string") return made;
  const taken = new Set(items.map((item) => item.name));
  const stem = /\d$/.test(made.name) ? made.name.replace(/\d+$/, "") : `${made.name} `;
  let number = items.length + 1;
  while (taken.has(`${stem}${number}`)) number += 1;
  made.name = `${stem}${number}`;
  return made;
}
