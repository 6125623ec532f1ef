// The public API, and what goes wrong with it.

import { askKey, key } from "./key.js";

// the page may be served below a prefix
const ROOT = new URL("../../", import.meta.url);
const PATIENCE_MS = 120_000;

export class Problem extends Error {
  constructor(status, content) {
    super(content?.detail ?? `The service answered ${status}.`);
    this.status = status;
    this.title = content?.title ?? "Something went wrong";
    this.errors = Array.isArray(content?.errors) ? content.errors : [];
  }
}

export const address = (path) => new URL(path.replace(/^\//, ""), ROOT).href;

const pause = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

async function problem(response) {
  const known = response.headers.get("content-type")?.includes("json");
  return new Problem(response.status, known ? await response.json().catch(() => null) : null);
}

/**
 * The response, once the service lets us in and is ready. `waiting` hears why it takes longer; a body that is a file
 * is sent as it is.
 * @param {string} method
 * @param {string} path
 * @param {{ body?: unknown, headers?: HeadersInit, signal?: AbortSignal, waiting?: (why: string) => void }} [more]
 */
export async function ask(method, path, { body, headers, signal, waiting } = {}) {
  const started = performance.now();
  for (;;) {
    const sent = new Headers(headers);
    const file = body instanceof Blob;
    if (body !== undefined) sent.set("Content-Type", file ? body.type : "application/json");
    const used = key();
    if (used) sent.set("Authorization", `Bearer ${used}`);
    let response;
    try {
      response = await fetch(address(path), { method, headers: sent, body: file ? body : body === undefined ? null : JSON.stringify(body), signal });
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Problem(0, { title: "No answer", detail: "The service does not answer." });
    }
    if (response.ok) return response;
    const found = await problem(response);
    // another call may have been given a key meanwhile
    if (response.status === 401 && (key() !== used || await askKey(found.message))) continue;
    const again = Number(response.headers.get("retry-after"));
    const worth = response.status === 429 || (response.status === 503 && found.title === "Not ready");
    if (!worth || !again || performance.now() - started > PATIENCE_MS) throw found;
    waiting?.(found.message);
    await pause(Math.min(again, 5));
  }
}

export const get = async (path, options) => (await ask("GET", path, options)).json();
// what is no JSON is a text, as a picture is
export const post = async (path, body, options) => {
  const found = await ask("POST", path, { body, ...options });
  return found.headers.get("content-type")?.includes("json") ? found.json() : found.text();
};

// Server-sent events. The browser's own reader cannot send a key.
export async function* events(path, signal) {
  const response = await ask("GET", path, { headers: { Accept: "text/event-stream" }, signal });
  if (!response.body) throw new Problem(response.status, null);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const blocks = (rest + value).split(/\r?\n\r?\n/);
    rest = blocks.pop() ?? "";
    for (const block of blocks) {
      const lines = block.split(/\r?\n/);
      const data = lines.filter((line) => line.startsWith("data:")).map((line) => line.slice(5).trimStart()).join("\n");
      const name = lines.find((line) => line.startsWith("event:"))?.slice(6).trim();
      if (data) yield { name, data: JSON.parse(data) };
    }
  }
}
