// The curve of an easing: time to the right, the way upwards; those with two handles are shaped by dragging them.

import { at, drawn, easing } from "./values.js";

const NAMED = {
  linear: [0, 0, 1, 1], ease: [0.25, 0.1, 0.25, 1], "ease-in": [0.42, 0, 1, 1], "ease-out": [0, 0, 0.58, 1], "ease-in-out": [0.42, 0, 0.58, 1],
};
const BEYOND = 0.45; // how far above and below a handle goes
const STEP = 0.02; // by an arrow key
const POINTS = 80;

export const handlesOf = (text) => {
  const numbers = /^cubic-bezier\(([^)]*)\)$/.exec(text)?.[1].split(",").map(Number);
  return NAMED[text] ?? (numbers?.length === 4 && numbers.every(Number.isFinite) ? numbers : null);
};

const textOf = (handles) => `cubic-bezier(${handles.map((value) => Number(value.toFixed(2))).join(",")})`;

export class EasingCurve {
  // `changed` is told of the text of an easing, and whether it is let go.
  constructor(canvas, changed) {
    Object.assign(this, { canvas, changed, handles: null, text: "linear" });
    canvas.setAttribute("viewBox", `-0.06 ${-BEYOND - 0.06} 1.12 ${1 + 2 * BEYOND + 0.12}`);
    canvas.append(drawn("path", { class: "frame", d: "M0 0H1V1H0Z" }), (this.curve = drawn("path", { class: "curve" })), (this.arms = drawn("path", { class: "arms" })));
    this.knobs = [0, 1].map((k) => {
      const knob = drawn("circle", { class: "knob", r: 0.045, tabindex: 0, role: "button", "aria-label": `Handle ${k + 1} of the easing, moved by arrow keys` });
      knob.addEventListener("pointerdown", (event) => {
        knob.setPointerCapture(event.pointerId);
        this.held = k;
      });
      knob.addEventListener("pointermove", (event) => this.held === k && this.move(k, this.place(event), false));
      knob.addEventListener("pointerup", () => {
        if (this.held === k) this.changed(textOf(this.handles), true);
        this.held = null;
      });
      knob.addEventListener("keydown", (event) => {
        const way = { ArrowRight: [STEP, 0], ArrowLeft: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] }[event.key];
        if (!way) return;
        event.preventDefault();
        this.move(k, [0, 1].map((axis) => this.handles[2 * k + axis] + way[axis]), true);
      });
      canvas.append(knob);
      return knob;
    });
  }

  place({ clientX, clientY }) {
    const { a, d, e, f } = this.canvas.getScreenCTM();
    return [(clientX - e) / a, 1 - (clientY - f) / d];
  }

  move(k, [x, y], isDone) {
    const handles = [...this.handles];
    handles[2 * k] = Math.min(Math.max(x, 0), 1);
    handles[2 * k + 1] = Math.min(Math.max(y, -BEYOND), 1 + BEYOND);
    this.draw(handles, handles);
    this.changed(textOf(handles), isDone);
  }

  // Shows an easing by its text, and as the blend has it.
  show(text, ease) {
    if (this.held != null) return;
    const handles = handlesOf(text);
    this.draw(handles, handles ?? ease ?? NAMED.linear);
  }

  draw(handles, ease) {
    this.handles = handles;
    const way = easing(ease);
    const points = Array.from({ length: POINTS + 1 }, (_, k) => `${k / POINTS} ${1 - way.at(k / POINTS)}`);
    this.curve.setAttribute("d", `M${points.join("L")}`);
    const places = handles ? [[handles[0], 1 - handles[1]], [handles[2], 1 - handles[3]]] : [];
    this.arms.setAttribute("d", places.length ? `M0 1L${places[0].join(" ")}M1 0L${places[1].join(" ")}` : "");
    this.knobs.forEach((knob, k) => {
      knob.toggleAttribute("hidden", !handles);
      if (!handles) return;
      knob.setAttribute("cx", places[k][0]);
      knob.setAttribute("cy", places[k][1]);
    });
  }
}
