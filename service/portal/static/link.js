// What the link keeps: the request, packed into the fragment, and the panels that are open.

const LONGEST = 1_000_000;

async function through(stream, bytes) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const chunks = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(chunks).arrayBuffer());
    size += value.length;
    // a short link may unpack to anything
    if (size > LONGEST) throw new RangeError("the link holds too much");
    chunks.push(value);
  }
}

export async function pack(value) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(value)));
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export async function unpack(text) {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
  return JSON.parse(new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes)));
}

// what panels remember: the unit of loads, what is traded, the chosen point of the front, the last sweep, the parts that were weighed
const KEPT = ["unit", "point", "trade", "count", "sweep", "match"];

// {example, request, open, kept}: an example stands for its request as long as nobody has edited it; "" is the empty machine
export async function readLink(fragment) {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const request = given.has("r") ? await unpack(given.get("r")) : null;
  const kept = Object.fromEntries(KEPT.filter((name) => given.has(name)).map((name) => [name, given.get(name)]));
  return { example: given.get("example"), request, open: given.get("open")?.split(",").filter(Boolean) ?? null, kept };
}

export async function writeLink({ example, request, open, kept }) {
  const link = new URLSearchParams();
  if (example) link.set("example", example);
  else if (example === null) link.set("r", await pack(request));
  link.set("open", open.join(","));
  for (const [name, value] of Object.entries(kept)) link.set(name, value);
  return `#${link}`.replaceAll("%2C", ",");
}
