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

export class Embedding {
  #host = parent === self ? null : framer();
  // what the next answer is the answer to; null once the user has changed something
  #id = null;
  #height = 0;

  /** @param {{ take: (given: any) => void, request: () => any }} page */
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
    if (said.type === `${PREFIX}machine`) {
      const given = said.request ?? (said.machine && { machine: said.machine });
      if (given === null || typeof given !== "object" || Array.isArray(given)) {
        this.failed({ title: "No machine", message: "The message holds neither a request nor a machine." }, id);
        return;
      }
      this.#id = id;
      page.take(given);
    } else if (said.type === `${PREFIX}picture`) {
      this.#picture(String(said.name), page.request(), id);
    }
  }

  async #picture(name, request, id) {
    try {
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
