// The question to the service: one at a time, and what is shown of its answer or of what is wrong.

import { found, showAnswer } from "./answer.js";
import { post, Problem } from "./api.js";
import { beginning } from "./beginning.js";
import { showChecked } from "./checked.js";
import { byId, h } from "./dom.js";
import { carried } from "./fitted.js";
import { complaint } from "./naming.js";

const STEP = { step_deg: 2 };

export class Run {
  // how many there were
  count = 0;
  #running = new AbortController();

  /** @param {any} page {work, panels, embedding, schema, form, outputs, drawings, examples, context} */
  constructor(page) {
    this.page = page;
  }

  stop() {
    this.count += 1;
    this.#running.abort();
    this.#running = new AbortController();
    return this.count;
  }

  // a machine of which there is nothing to show yet
  async begin() {
    const number = this.stop();
    byId("problem").replaceChildren();
    byId("trouble").textContent = "";
    byId("answer").replaceChildren();
    this.page.drawings.clear();
    byId("results").classList.add("empty");
    byId("results").removeAttribute("aria-busy");
    byId("progress").textContent = "A new machine: type it, then press Optimise.";
    const { examples } = await this.page.examples.catch(() => ({ examples: [] }));
    if (number === this.count) byId("answer").prepend(beginning(examples, this.page.context.adopt));
  }

  async ask() {
    const { work, panels, outputs } = this.page;
    const started = performance.now();
    const number = this.stop();
    const asked = work.changes;
    const results = byId("results");
    const progress = byId("progress");
    results.setAttribute("aria-busy", "true");
    results.dataset.asked = String(number);
    progress.textContent = "Computing …";
    const { request } = work;
    const body = { angles: STEP, ...request, outputs: outputs.first(request) };
    try {
      const answer = await post("v1/optimize", body, { signal: this.#running.signal, waiting: (why) => { progress.textContent = why; } });
      if (number !== this.count) return;
      const drawn = this.#answered(request, answer, work.changes === asked);
      if (work.changes === asked) progress.textContent = `Answered in ${Math.round(performance.now() - started)} ms.`;
      await panels.show({ ...this.page.context, request, answer, number, kept: work.kept, call: { method: "POST", path: "v1/optimize", body } });
      await drawn;
      if (number !== this.count) return;
      Object.assign(results.dataset, { drawn: number, ms: Math.round(performance.now() - started) });
      // never before it is shown, and nobody waits for it
      results.removeAttribute("aria-busy");
      await showChecked(byId("answer").querySelector(".proof"), body, answer, this.#running.signal);
    } catch (error) {
      if (error.name === "AbortError" || number !== this.count) return;
      if (!(error instanceof Problem)) console.error(error);
      progress.textContent = "";
      await this.complain(error);
    } finally {
      if (number === this.count) results.removeAttribute("aria-busy");
    }
  }

  // resolves when it is drawn
  #answered(request, answer, current) {
    const { work, embedding, outputs, form, drawings } = this.page;
    form()?.errors.clear();
    byId("problem").replaceChildren();
    byId("trouble").textContent = "";
    showAnswer(byId("answer"), request, answer, outputs.all(request), drawings.element);
    byId("results").classList.remove("empty");
    // what was typed meanwhile is not answered
    byId("results").classList.toggle("stale", !current);
    if (current) work.unsaved = false;
    work.keep();
    embedding.say("answer", { request, answer });
    return current ? drawings.ask(request, carried(found(answer)), request.fitted) : drawings.ask(work.request);
  }

  async complain(error) {
    this.page.embedding.failed(error);
    byId("results").classList.add("stale");
    await this.page.schema.catch(() => null);
    const blame = this.page.form()?.errors;
    const errors = error.errors ?? [];
    const homeless = blame ? blame.say(errors) : errors;
    // where the eye is after the button: above it, and beside it
    const [first] = errors;
    const { request } = this.page.work;
    const worded = ({ pointer, message }) => complaint(request, { pointer, message: blame ? blame.meant(pointer, message) : message });
    byId("trouble").textContent = first ? worded(first) : error.message;
    byId("progress").textContent = errors.length > 1 ? `Not computed: ${errors.length} fields are wrong.` : "Not computed.";
    byId("problem").replaceChildren(h("h2", {}, error.title ?? "Something went wrong"), h("p", {}, error.message),
      homeless.length ? h("ul", {}, homeless.map((one) => h("li", {}, complaint(request, one)))) : "");
  }
}
