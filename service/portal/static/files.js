// Files for the reader to keep.

import { h } from "./dom.js";

const KEPT_MS = 10_000;

export function save(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}

// a name that every system takes for a file
export const fileName = (name, ending) => `${String(name ?? "").replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^-+|-+$/g, "").slice(0, 80) || "machine"}.${ending}`;

export const saveJson = (content, name) => save(new Blob([`${JSON.stringify(content, null, 2)}\n`], { type: "application/json" }), name);

// the name that the service gives a file
export function named(answer) {
  const said = answer.headers.get("content-disposition") ?? "";
  const coded = /filename\*=UTF-8''([^;]+)/.exec(said);
  return coded ? decodeURIComponent(coded[1]) : /filename="([^"]*)"/.exec(said)?.[1];
}
