// Drawings that are looked at closely: how large, and which part of them.

import { at } from "./values.js";

const MOST = 40; // times
const STEP = 1.5; // times, by a button or a key
const STILL = 5; // pixels that a pointer moves in a click

export class Zoom {
  // `view` returns what is seen without it, nothing as long as no drawing is shown; `changed` is told of every change; `drags` whether a drag moves the drawing.
  constructor(canvas, { view, changed, drags }) {
    Object.assign(this, { canvas, view, changed, drags, factor: 1, centre: [0.5, 0.5], from: null });
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      this.moved = false;
      if (this.factor === 1 || !(event.button === 1 || (event.button === 0 && drags()))) return;
      this.from = [event.clientX, event.clientY];
      if (event.button === 1) event.preventDefault();
    });
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (this.from = null));
  }

  // What is seen of a view.
  box([x, y, width, height]) {
    const { factor, centre } = this;
    return [x + width * (centre[0] - 0.5 / factor), y + height * (centre[1] - 0.5 / factor), width / factor, height / factor];
  }

  // Larger or smaller; the point with these shares of the view stays where it is.
  by(times, place = this.centre) {
    const factor = Math.min(Math.max(this.factor * times, 1), MOST);
    const share = this.factor / factor;
    this.go(factor, this.centre.map((c, k) => place[k] + (c - place[k]) * share));
  }

  go(factor, centre) {
    if (!this.view()) return;
    const half = 0.5 / factor;
    this.factor = factor;
    this.centre = centre.map((c) => Math.min(Math.max(c, half), 1 - half));
    this.canvas.classList.toggle("zoomed", factor > 1);
    this.changed();
  }

  // A length on the screen as shares of the view.
  shares(right, down) {
    const { a, d } = this.canvas.getScreenCTM();
    const [, , width, height] = this.view();
    return [right / a / width, down / d / height];
  }

  wheel(event) {
    if (!this.view()) return;
    if (event.ctrlKey || event.metaKey) {
      const { e, f } = this.canvas.getScreenCTM();
      const [x, y, width, height] = this.view();
      const [right, down] = this.shares(event.clientX - e, event.clientY - f);
      this.by(1.01 ** -event.deltaY, [right - x / width, down - y / height]);
    } else if (this.factor > 1) {
      const [right, down] = this.shares(event.deltaX, event.deltaY);
      this.go(this.factor, [this.centre[0] + right, this.centre[1] + down]);
    } else {
      return;
    }
    event.preventDefault();
  }

  drag({ clientX, clientY, pointerId }) {
    if (!this.from) return;
    const [right, down] = [clientX - this.from[0], clientY - this.from[1]];
    this.moved ||= Math.hypot(right, down) > STILL;
    if (!this.moved) return;
    this.canvas.setPointerCapture(pointerId);
    const [x, y] = this.shares(right, down);
    this.go(this.factor, [this.centre[0] - x, this.centre[1] - y]);
    this.from = [clientX, clientY];
  }
}

// Buttons and keys, which change all drawings together.
export function zoomAll(zooms, changed) {
  const act = {
    "zoom-in": () => zooms.forEach((zoom) => zoom.by(STEP)),
    "zoom-out": () => zooms.forEach((zoom) => zoom.by(1 / STEP)),
    "zoom-fit": () => zooms.forEach((zoom) => zoom.go(1, [0.5, 0.5])),
  };
  const keys = { "+": "zoom-in", "=": "zoom-in", "-": "zoom-out", 0: "zoom-fit" };
  for (const [name, go] of Object.entries(act)) {
    at(name).addEventListener("click", () => {
      go();
      changed();
    });
  }
  addEventListener("keydown", (event) => {
    const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && !/^(range|checkbox)$/.test(event.target.type);
    if (keys[event.key] && !isTyping && !event.ctrlKey && !event.metaKey && !event.altKey) at(keys[event.key]).click();
  });
}
