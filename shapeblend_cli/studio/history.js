// What was done, to be undone and done again.

export class History {
  constructor(first) {
    Object.assign(this, { present: first, past: [], future: [] });
  }

  // Takes what is so now, and in a word what was done.
  commit(next, what) {
    if (JSON.stringify(next) === JSON.stringify(this.present)) return false;
    this.past.push({ state: this.present, what });
    this.present = next;
    this.future = [];
    return true;
  }

  undo() {
    return this.go(this.past, this.future);
  }

  redo() {
    return this.go(this.future, this.past);
  }

  go(from, to) {
    const step = from.pop();
    if (!step) return null;
    to.push({ state: this.present, what: step.what });
    this.present = step.state;
    return step.what;
  }
}
