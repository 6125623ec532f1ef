// The machine that is worked on: what it is, what was done to it, and that nothing of it is lost.

import { Edits } from "./edits.js";
import { Later } from "./later.js";
import { writeLink } from "./link.js";
import { store } from "./session.js";

const LATER_MS = 400;

export class Work {
  /** @type {any} */
  request = null;
  /** @type {string | null} its name, as long as nobody has changed it; "" is the empty machine */
  example = null;
  /** @type {{ [name: string]: any }} what panels remember */
  kept = {};
  changes = 0;
  // edited since the last answer or file
  unsaved = false;
  // changed since link and session were written
  unkept = false;
  // how often the reader went elsewhere
  places = 0;
  #edits = new Edits();
  #later = new Later(() => this.keep(), LATER_MS);
  #links = 0;
  #pushing = false;
  // the reader went elsewhere, and what is there has not come yet
  #left = false;

  /** @param {() => string[]} open the panels that the link names */
  constructor(open) {
    this.open = open;
    const last = () => this.unkept && this.#store();
    addEventListener("pagehide", last);
    document.addEventListener("visibilitychange", () => document.hidden && last());
  }

  // another machine
  begin(request, example, kept) {
    Object.assign(this, { request, example, kept });
    this.#left = false;
    this.#edits.record(request, example);
  }

  edit(request, pointer) {
    this.request = request;
    this.example = null;
    this.#edits.record(request, null, pointer);
  }

  get undoable() {
    return this.#edits.undoable;
  }

  get redoable() {
    return this.#edits.redoable;
  }

  /** @param {"undo" | "redo"} which whether there was anything */
  go(which) {
    const found = this.#edits[which]();
    Object.assign(this, found);
    return found !== null;
  }

  changed() {
    this.unsaved = true;
    this.#left = false;
    this.changes += 1;
    // a sweep goes on and is still to be found; the points of the front are no longer the same
    delete this.kept.point;
    this.unkept = true;
    this.#later.ask();
  }

  // Link and session, now. Our own change of the fragment is no navigation; of several that are packed at once the last
  // one counts. `push`: Back leads to what was there before.
  async keep({ push = false } = {}) {
    this.#later.cancel();
    if (this.#left) return;
    this.unkept = true;
    this.#pushing ||= push;
    const number = (this.#links += 1);
    const link = await writeLink({ ...this, open: this.open() });
    if (number !== this.#links) return;
    if (link !== location.hash) history[this.#pushing ? "pushState" : "replaceState"](null, "", link);
    this.#pushing = false;
    this.#store();
  }

  // the reader went elsewhere: what is being packed, or is answered yet, is no longer the link of this place
  leave() {
    this.#later.cancel();
    this.#left = true;
    this.#pushing = false;
    this.#links += 1;
    this.places += 1;
  }

  #store() {
    this.unkept = false;
    if (this.request) store({ request: this.request, example: this.example });
  }
}
