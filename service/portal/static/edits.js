// Everything that was done to the request, to be undone and done again. States share what did not change.

// of what was done longest ago the page forgets the rest
const MOST = 1_000;

export class Edits {
  #past = [];
  #future = [];
  /** @type {{ request: any, example: string | null } | null} */
  #now = null;
  #pointer = null;

  // typing on in one field is one edit
  record(request, example, pointer = null) {
    if (this.#now?.request === request) return;
    if (this.#now && (pointer === null || pointer !== this.#pointer)) this.#past.push(this.#now);
    this.#now = { request, example };
    this.#pointer = pointer;
    this.#future = [];
    if (this.#past.length > MOST) this.#past.shift();
  }

  get undoable() {
    return this.#past.length > 0;
  }

  get redoable() {
    return this.#future.length > 0;
  }

  undo() {
    return this.#go(this.#past, this.#future);
  }

  redo() {
    return this.#go(this.#future, this.#past);
  }

  #go(from, to) {
    const found = from.pop();
    if (!found) return null;
    to.push(this.#now);
    this.#now = found;
    this.#pointer = null;
    return found;
  }
}
