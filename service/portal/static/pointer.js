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

// undefined removes; what is missing on the way is made
export function set(root, pointer, value) {
  const parts = split(pointer);
  const last = parts.pop();
  let node = root;
  for (const part of parts) {
    if (!Object.hasOwn(node, part) || node[part] === null || typeof node[part] !== "object") {
      Object.defineProperty(node, part, { value: {}, writable: true, enumerable: true, configurable: true });
    }
    node = node[part];
  }
  if (value === undefined && Array.isArray(node)) node.splice(Number(last), 1);
  else if (value === undefined) delete node[last];
  else Object.defineProperty(node, last, { value, writable: true, enumerable: true, configurable: true });
}
