// Everything that was done to the request, to be undone and done again.

// of what was done longest ago the page forgets the rest
const LARGEST = 20_000_000;

export class Edits {
  #past = [];
  #future = [];
  /** @type {{ text: string, example: string | null } | null} */
  #now = null;
  #pointer = null;

  // typing on in one field is one edit
  record(request, example, pointer = null) {
    const text = JSON.stringify(request);
    if (this.#now?.text === text) return;
    if (this.#now && (pointer === null || pointer !== this.#pointer)) this.#past.push(this.#now);
    this.#now = { text, example };
    this.#pointer = pointer;
    this.#future = [];
    let size = 0;
    const kept = this.#past.findLastIndex((one) => (size += one.text.length) > LARGEST);
    this.#past.splice(0, kept + 1);
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
    return { request: JSON.parse(found.text), example: found.example };
  }
}
