// JSON pointers (RFC 6901).

const escape = (part) => String(part).replaceAll("~", "~0").replaceAll("/", "~1");
const unescape = (part) => part.replaceAll("~1", "/").replaceAll("~0", "~");

export const join = (pointer, part) => `${pointer}/${escape(part)}`;
export const split = (pointer) => pointer.split("/").slice(1).map(unescape);
export const parent = (pointer) => pointer.slice(0, pointer.lastIndexOf("/"));

export function get(root, pointer) {
  return split(pointer).reduce((node, part) => (node !== null && typeof node === "object" && Object.hasOwn(node, part)
    ? node[part] : undefined), root);
}

// The same with another value there; undefined removes, and what is missing on the way is made. What was given stays
// as it is: all that stands beside the way is shared.
export const put = (root, pointer, value) => changed(root, split(pointer), value);

/** @returns {any} */
function changed(node, [part, ...rest], value) {
  const known = node !== null && typeof node === "object";
  const before = known && Object.hasOwn(node, part) ? node[part] : undefined;
  const now = rest.length ? changed(before, /** @type {[any, ...any[]]} */ (rest), value) : value;
  if (Object.is(now, before)) return node;
  const made = Array.isArray(node) ? [...node] : known ? { ...node } : {};
  if (now !== undefined) Object.defineProperty(made, part, { value: now, writable: true, enumerable: true, configurable: true });
  else if (Array.isArray(made)) made.splice(Number(part), 1);
  else delete made[part];
  return made;
}
