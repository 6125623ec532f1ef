// The page in the frame of another one, and what is said between them: messages {type, id, ...}.
//
// heard   counterweight.machine {request} or {machine}: is taken and optimised; counterweight.picture {name}
// said    counterweight.ready {version}, counterweight.answer {request, answer}, counterweight.picture {name, svg},
//         counterweight.error {title, message, errors}, counterweight.height {height}
//
// Only the origins that the service names may frame the page (its policy), and none but they are listened or spoken to.

import { ask, get } from "./api.js";

const meta = document.querySelector('meta[name="frame-origins"]');
const known = meta instanceof HTMLMetaElement ? meta.content.split(" ").filter(Boolean) : [];
const PREFIX = "counterweight.";

// who frames the page, as far as the browser tells; the first message says it too
function framer() {
  const [origin] = /** @type {any} */ (location).ancestorOrigins ?? [];
  return origin ?? (document.referrer ? new URL(document.referrer).origin : null);
}

// What a message holds, as JSON: one that refers to itself, or holds what JSON has no word for, can neither be sent nor
// be kept, and a page that once had it would never be rid of it.
function plain(given) {
  const text = JSON.stringify(given, (name, value) => {
    if (typeof value === "number" && !Number.isFinite(value)) throw new TypeError(`${name} is ${value}`);
    return value;
  });
  return text === undefined ? null : JSON.parse(text);
}

export class Embedding {
  #host = parent === self ? null : framer();
  // what the next answer is the answer to; null once the user has changed something
  #id = null;
  #height = 0;

  /** @param {{ take: (given: any) => Promise<void>, request: () => any }} page */
  constructor(page) {
    if (parent === self) return;
    document.documentElement.dataset.framed = "";
    addEventListener("message", (event) => {
      if (event.source !== parent || !known.includes(event.origin)) return;
      this.#host = event.origin;
      this.#heard(Object(event.data), page);
    });
    new ResizeObserver(() => this.#measure()).observe(document.body);
    get("v1/version").then(({ version }) => this.say("ready", { version }), (error) => this.failed(error));
  }

  /** @param {string} kind @param {object} content @param {unknown} [id] */
  say(kind, content, id = this.#id) {
    if (this.#host !== null && known.includes(this.#host)) {
      parent.postMessage({ type: PREFIX + kind, id, ...content }, this.#host);
    }
  }

  /** @param {any} error @param {unknown} [id] */
  failed(error, id = this.#id) {
    this.say("error", { title: error.title ?? "Something went wrong", message: error.message, errors: error.errors ?? [] }, id);
  }

  edited() {
    this.#id = null;
  }

  #heard(said, page) {
    const id = said.id ?? null;
    if (said.type === `${PREFIX}machine`) this.#machine(said, page, id);
    else if (said.type === `${PREFIX}picture`) this.#picture(said.name, page.request(), id);
  }

  async #machine(said, page, id) {
    try {
      const given = plain(said.request ?? (said.machine && { machine: said.machine }));
      if (given === null || typeof given !== "object" || Array.isArray(given)) throw new TypeError("it holds neither a request nor a machine");
      this.#id = id;
      await page.take(given);
    } catch (error) {
      this.failed({ title: "No machine", message: `The message cannot be taken: ${error.message}.` }, id);
    }
  }

  async #picture(name, request, id) {
    try {
      if (typeof name !== "string") throw new Error("The name of a picture is a text.");
      if (request === null) throw new Error("There is no machine yet.");
      const found = await ask("POST", `v1/pictures/${encodeURIComponent(name)}`, { body: request });
      this.say("picture", { name, svg: await found.text() }, id);
    } catch (error) {
      this.failed(error, id);
    }
  }

  #measure() {
    const height = Math.ceil(document.body.getBoundingClientRect().height);
    if (height === this.#height) return;
    this.#height = height;
    this.say("height", { height }, null);
  }
}
