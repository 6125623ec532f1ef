// Several cells of one column under edit at once: a column by its head, rows by Shift and the arrow keys.

export class Selection {
  column = -1;
  // the caret stands in the first row, the other end moves
  anchor = 0;
  end = 0;

  /** @param {HTMLElement} body of the table @param {number} ahead cells before the first column */
  constructor(body, ahead) {
    this.body = body;
    this.ahead = ahead;
  }

  choose(column, anchor, end) {
    Object.assign(this, { column, anchor, end: Math.min(Math.max(end, 0), this.body.childElementCount - 1) });
    [...this.body.children].forEach((line, row) => [...line.children].forEach((cell, at) => {
      cell.classList.toggle("chosen", anchor !== this.end && this.holds(row, at - this.ahead));
    }));
  }

  clear() {
    if (this.column >= 0) this.choose(-1, 0, 0);
  }

  // one row more, or one less, from where the caret is
  extend(row, column, by) {
    if (column === this.column && row === this.anchor) this.choose(column, row, this.end + by);
    else this.choose(column, row, row + by);
  }

  holds(row, column) {
    return column === this.column && row >= Math.min(this.anchor, this.end) && row <= Math.max(this.anchor, this.end);
  }

  // the other rows that take what is typed into a cell
  others(row, column) {
    return this.holds(row, column) ? Array.from(this.body.children, (_, index) => index).filter((one) => one !== row && this.holds(one, column)) : [];
  }
}
