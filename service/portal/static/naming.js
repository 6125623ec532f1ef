// What a pointer of a request is called on the page: things by name, or counted from 1.

import { label, nameOf, singular } from "./format.js";
import { get, join, split } from "./pointer.js";

// what is what it is without its place in the request
const PLAIN = new Set(["machine", "objective", "document"]);

// "throw 1, row I: reciprocating mass"
export function called(request, pointer) {
  const parts = split(pointer);
  const last = parts.pop() ?? "";
  const around = [];
  let at = "";
  for (const part of parts) {
    const list = Array.isArray(get(request, at));
    at = join(at, part);
    if (list && around.length) around[around.length - 1] = `${singular(around.at(-1))} ${nameOf(get(request, at), Number(part))}`;
    else if (!PLAIN.has(part)) around.push(label(part));
  }
  // the place of a thing in its list is the thing
  const count = Array.isArray(get(request, at)) || /^\d+$/.test(last);
  const own = count && around.length ? `${singular(around.pop() ?? "")} ${nameOf(get(request, join(at, last)), Number(last))}` : label(last);
  return `${around.join(", ")}${around.length ? ": " : ""}${own}`;
}

// an error in words, whose pointer nobody has to read
export const complaint = (request, { pointer, message }) => (pointer ? `${called(request, pointer)}: ${message}` : message);
