// What users do with the drawings: pair parts, pin points, stiffen stretches of an outline; by pointer and by keys.

import { at, counted, drawn } from "./values.js";
import { middle, pointsOf, regionOf } from "./panel.js";

const HINTS = {
  pair: "Click a part of A, then the part of B that it becomes.",
  pin: "Drag a point of A onto the point of B where it goes; or click one, then the other.",
  stiff: "Drag along an outline of A to make that stretch keep its shape.",
};
const WEIGHT = 4; // how much stiffer a stretch becomes
const SHOWN = 24; // places that are shown with where they go
const hue = (k, count) => `hsl(${Math.round((330 * k) / Math.max(count, 1))} 78% 42%)`;

export class Tools {
  // `app` has the options in force and takes changes: get, change, attempt, say, partners.
  constructor(panels, app) {
    Object.assign(this, { panels, app, tool: "pair", held: null, drag: null, pointed: null, picked: null, cursor: { a: null, b: null } });
    for (const panel of Object.values(panels)) {
      this.listen(panel);
      panel.redraw = () => this.redraw();
    }
    for (const button of document.querySelectorAll("[data-tool]")) {
      button.addEventListener("click", () => this.choose(button.dataset.tool));
      button.addEventListener("keydown", (event) => this.chooseByKey(event));
    }
    this.choose("pair");
  }

  get canCorrect() {
    return this.app.isPair();
  }

  choose(tool) {
    this.letGo(); // what is held belongs to the tool before
    this.pointed = null;
    this.tool = tool;
    for (const button of document.querySelectorAll("[data-tool]")) {
      const isIt = button.dataset.tool === tool;
      button.setAttribute("aria-checked", isIt);
      button.tabIndex = isIt ? 0 : -1;
    }
    at("panels").dataset.using = tool;
    this.hint();
    this.redraw();
  }

  chooseByKey(event) {
    const tools = Object.keys(HINTS);
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    const next = tools[(tools.indexOf(this.tool) + step + tools.length) % tools.length];
    this.choose(next);
    document.querySelector(`[data-tool=${next}]`).focus();
    event.preventDefault();
    event.stopPropagation();
  }

  hint() {
    this.app.say(this.canCorrect ? HINTS[this.tool] : "Corrections apply to two drawings; these are more.");
  }

  letGo() {
    const had = this.held || this.drag;
    Object.assign(this, { held: null, drag: null, picked: null });
    if (had) {
      this.app.attempt(null);
      this.hint();
    }
    this.redraw();
    return Boolean(had);
  }

  // What is held, pointed at or chosen belongs to drawings that are gone.
  forget() {
    Object.assign(this, { held: null, drag: null, pointed: null, picked: null, cursor: { a: null, b: null }, isByKeys: false });
  }

  other(panel) {
    return this.panels[panel.side === "a" ? "b" : "a"];
  }

  // ---- by pointer

  listen(panel) {
    const { canvas } = panel;
    canvas.addEventListener("pointerdown", (event) => this.down(panel, event));
    canvas.addEventListener("pointermove", (event) => this.move(panel, event));
    canvas.addEventListener("pointerup", (event) => this.up(panel, event));
    canvas.addEventListener("pointercancel", () => this.letGo());
    canvas.addEventListener("pointerleave", () => {
      if (!this.drag) this.point(null);
    });
    canvas.addEventListener("keydown", (event) => this.key(panel, event));
    canvas.addEventListener("focus", () => this.focus(panel));
    canvas.addEventListener("blur", () => {
      this.isByKeys = false;
      this.redraw();
    });
  }

  down(panel, event) {
    if (event.button || !this.canCorrect) return;
    this.isByKeys = false;
    const point = panel.point(event);
    if (this.tool === "pair") {
      this.pressed = { panel, number: panel.partAt(point) };
      return;
    }
    const pin = this.tool === "pin" ? this.pinAt(panel, point) : null;
    const spot = pin ? { at: pin.points[panel.side === "a" ? 0 : 1] } : panel.spotAt(point);
    if (!spot || (this.tool === "stiff" && panel.side === "b")) {
      if (this.tool === "stiff") this.app.say("Stiffness is of outlines of A: drag along one there.");
      return;
    }
    panel.canvas.setPointerCapture(event.pointerId);
    // A pin that is there already is moved: its other end stays.
    const from = pin ? { panel: this.other(panel), spot: { at: pin.points[panel.side === "a" ? 1 : 0] } } : { panel, spot };
    this.drag = { panel, from, began: [event.clientX, event.clientY], path: [spot.at], moved: false, pin, to: null, event };
    this.redraw();
    event.preventDefault();
  }

  move(panel, event) {
    const { drag } = this;
    if (!drag) {
      this.point(panel, panel.point(event));
      return;
    }
    drag.event = event;
    drag.moved ||= Math.hypot(event.clientX - drag.began[0], event.clientY - drag.began[1]) > 5;
    if (!drag.moved) return;
    if (this.tool === "stiff") {
      const spot = panel.spotAt(panel.point(event), 40);
      if (spot) drag.path.push(spot.at);
    } else {
      const goal = this.other(drag.from.panel);
      drag.to = goal.isOver(event) ? goal.spotAt(goal.point(event), 60) : null;
      this.app.attempt(drag.to ? this.withPin(drag.from, drag.to, drag.pin) : null);
    }
    this.redraw();
  }

  up(panel, event) {
    if (this.tool === "pair") {
      const { pressed } = this;
      this.pressed = null;
      const number = panel.partAt(panel.point(event));
      if (!this.canCorrect || panel.zoom.moved || !pressed || pressed.panel !== panel || pressed.number !== number) return;
      if (number === null) this.letGo();
      else this.take(panel, { number });
      return;
    }
    const { drag } = this;
    if (!drag) return;
    this.drag = null;
    if (this.tool === "stiff") {
      if (drag.moved) this.stiffen(drag.path);
      else this.app.say("Drag along the outline, from where it begins to be stiff to where it ends.");
    } else if (!drag.moved) {
      if (drag.pin) this.pick(panel.side, drag.pin.index);
      else this.take(panel, drag.from.spot);
    } else if (drag.to) {
      this.pin(drag.from, drag.to, drag.pin);
    } else {
      this.app.attempt(null);
      this.app.say(`Let go over ${drag.from.panel.side === "a" ? "B" : "A"}, and the point goes there.`);
    }
    this.redraw();
  }

  point(panel, point = null) {
    const before = JSON.stringify(this.pointed && { ...this.pointed, panel: this.pointed.panel.side });
    this.pointed = null;
    if (panel && this.canCorrect) {
      if (this.tool === "pair") {
        const number = panel.partAt(point);
        this.pointed = number === null ? null : { panel, number };
      } else {
        const spot = panel.spotAt(point);
        this.pointed = spot ? { panel, number: spot.number, spot } : null;
      }
    }
    panel?.canvas.classList.toggle("over", Boolean(this.pointed));
    if (JSON.stringify(this.pointed && { ...this.pointed, panel: this.pointed.panel.side }) !== before) this.redraw();
  }

  pinAt(panel, point) {
    const reach = 12 / panel.scale;
    const side = panel.side === "a" ? 0 : 1;
    for (const [index, text] of (this.app.get("pin") ?? []).entries()) {
      const points = pointsOf(text);
      if (points && Math.hypot(points[side][0] - point[0], points[side][1] - point[1]) < reach) return { index, points };
    }
    return null;
  }

  // ---- what comes of it

  // One half of a pair or of a pin; the second one completes it.
  take(panel, what) {
    const { held } = this;
    if (!held || held.panel === panel) {
      const again = held && (this.tool === "pair" ? held.what.number === what.number : false);
      this.held = again ? null : { panel, what };
      const goal = this.other(panel).side.toUpperCase();
      if (again) this.hint();
      else if (this.tool === "pair") this.app.say(`Now the part of ${goal} ${panel.side === "a" ? "that it becomes" : "that becomes it"}.`);
      else this.app.say(`Now the point of ${goal}.`);
      this.redraw();
      return;
    }
    this.held = null;
    if (this.tool === "pair") this.pair({ [held.panel.side]: held.what.number, [panel.side]: what.number });
    else this.pin({ panel: held.panel, spot: held.what }, what, null);
    this.redraw();
  }

  // What was said of either part gives way, by number or by id.
  pair({ a, b }) {
    const isSame = (text) => {
      const [one, other] = text.split("=");
      return this.panels.a.isCalled(a, one) || this.panels.b.isCalled(b, other);
    };
    const others = (this.app.get("match") ?? []).filter((text) => text.includes(":") || !isSame(text));
    this.app.change({ match: [...others, `${a}=${b}`] }, "pair");
    this.app.say(`Part ${a} of A becomes part ${b} of B.`, true);
  }

  withPin(from, to, pin) {
    const ends = { [from.panel.side]: from.spot.at, [from.panel.side === "a" ? "b" : "a"]: to.at };
    const text = `${this.panels.a.text(ends.a)}:${this.panels.b.text(ends.b)}`;
    const pins = [...(this.app.get("pin") ?? [])];
    if (pin) pins[pin.index] = text;
    else pins.push(text);
    return { pin: pins };
  }

  pin(from, to, pin) {
    this.app.change(this.withPin(from, to, pin), pin ? "move of a pin" : "pin");
    this.app.say("Pinned. Drag either end to move it, or click it and press arrow keys.", true);
  }

  stiffen(path) {
    const { a } = this.panels;
    const { centre, radius } = middle(path);
    const [width] = a.drawing.view.slice(2);
    const reach = Number(Math.max(radius, width / 100).toFixed(a.drawing.decimals + 1));
    this.app.change({ stiff: [...(this.app.get("stiff") ?? []), `${a.text(centre)},${reach}=${WEIGHT}`] }, "stiff region");
    this.app.say(`Within this circle the wire is ${WEIGHT} times as stiff.`, true);
  }

  // One end of a pin, to be moved by keys.
  pick(side, index) {
    if (this.tool !== "pin") this.choose("pin");
    this.picked = { side, index };
    this.panels[side].canvas.focus();
    this.app.say(`Arrow keys move the end of pin ${index + 1} in ${side.toUpperCase()} by a pixel, with Shift by ten.`);
    this.redraw();
  }

  nudge(right, down) {
    const { side, index } = this.picked;
    const pins = [...(this.app.get("pin") ?? [])];
    const points = pointsOf(pins[index] ?? "");
    if (!points) return;
    const { scale } = this.panels[side];
    const end = points[side === "a" ? 0 : 1];
    end[0] += right / scale;
    end[1] += down / scale;
    pins[index] = `${this.panels.a.text(points[0])}:${this.panels.b.text(points[1])}`;
    this.app.change({ pin: pins }, `nudge of pin ${index + 1}`, true);
  }

  // A part that somebody is told of: shown as if it were pointed at, and with the tool that helps.
  hover(side, number) {
    this.pointed = side ? { panel: this.panels[side], number } : null;
    this.redraw();
  }

  lookAt(side, number, tool) {
    this.choose(tool);
    if (tool === "pair") this.take(this.panels[side], { number });
    else this.hover(side, number);
    this.panels[side].canvas.scrollIntoView({ block: "nearest" });
  }

  // ---- by keys

  focus(panel) {
    if (!panel.drawing || !panel.canvas.matches(":focus-visible")) return;
    this.isByKeys = true;
    this.cursor[panel.side] ??= { part: 0, node: 0 };
    this.tell(panel);
  }

  at(panel) {
    const cursor = this.cursor[panel.side];
    const number = panel.order[cursor.part % panel.order.length];
    const contour = panel.contours[number];
    const places = cursor.fine ? panel.samples(contour) : contour.nodes;
    return { number, contour, places, at: places[cursor.node % places.length] };
  }

  tell(panel) {
    const { number, places, at: [x, y] } = this.at(panel);
    const name = panel.side.toUpperCase();
    const partner = this.app.partners(panel.side, number);
    const becomes = partner.length ? `, with ${partner.join(" and ")} of ${panel.side === "a" ? "B" : "A"}` : ", alone";
    const node = this.tool === "pair" ? "" : `, point ${(this.cursor[panel.side].node % places.length) + 1} of ${places.length} at ${panel.text([x, y])}`;
    this.app.say(`${name}: part ${number} of ${panel.contours.length}${becomes}${node}.`);
    this.redraw();
  }

  key(panel, event) {
    if (!panel.drawing || event.ctrlKey || event.metaKey || event.altKey) return;
    const way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key];
    if (way && this.picked) {
      this.nudge(...way.map((step) => step * (event.shiftKey ? 10 : 1)));
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    const cursor = (this.cursor[panel.side] ??= { part: 0, node: 0 });
    const parts = panel.order.length;
    const turn = (step) => () => {
      if (this.tool === "pair") cursor.part = (cursor.part + step + parts) % parts;
      else {
        if (Boolean(event.shiftKey) !== Boolean(cursor.fine)) this.refine(panel, cursor, event.shiftKey);
        const { places } = this.at(panel);
        cursor.node = (cursor.node + step + places.length) % places.length;
      }
    };
    const part = (step) => () => Object.assign(cursor, { part: (cursor.part + step + parts) % parts, node: 0, fine: false });
    const moves = { ArrowRight: turn(1), ArrowLeft: turn(-1), ArrowDown: part(1), ArrowUp: part(-1) };
    if (moves[event.key]) {
      this.isByKeys = true;
      moves[event.key]();
      this.tell(panel);
      this.follow(panel);
    } else if (event.key === "Enter") {
      if (!this.canCorrect) return;
      this.isByKeys = true;
      this.enter(panel);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  // Fine steps go on from where coarse ones were.
  refine(panel, cursor, fine) {
    const { at: [x, y], contour } = this.at(panel);
    cursor.fine = fine;
    const places = fine ? panel.samples(contour) : contour.nodes;
    const offs = places.map(([u, v]) => (u - x) ** 2 + (v - y) ** 2);
    cursor.node = offs.indexOf(Math.min(...offs));
  }

  enter(panel) {
    const place = this.at(panel);
    const wasHeld = this.held;
    if (this.tool === "stiff") {
      if (panel.side === "b") this.app.say("Stiffness is of outlines of A.");
      else if (!wasHeld) {
        this.held = { panel, what: { number: place.number, at: place.at }, path: [place.at] };
        this.app.say("Now the point where the stiff stretch ends, and Enter.");
      } else {
        this.held = null;
        this.stiffen([...wasHeld.path, place.at]);
      }
      this.redraw();
      return;
    }
    this.take(panel, { number: place.number, at: place.at });
    if (!this.held) return; // complete
    const goal = this.other(panel);
    const said = at("says").textContent;
    goal.canvas.focus();
    this.cursor[goal.side] ??= { part: 0, node: 0 };
    // The partner is where the other half is looked for first.
    const [partner] = this.app.partners(panel.side, place.number);
    if (partner !== undefined) this.cursor[goal.side] = { part: goal.order.indexOf(partner), node: 0 };
    this.isByKeys = true;
    this.app.say(`${said} Arrows move, Enter takes it, Escape lets go.`);
    this.redraw();
  }

  // While one end is held, the other is tried wherever the cursor is.
  follow(panel) {
    const { held } = this;
    if (held?.path) held.path.push(this.at(panel).at);
    else if (held && this.tool === "pin" && held.panel !== panel) {
      this.app.attempt(this.withPin({ panel: held.panel, spot: held.what }, this.at(panel), null));
    }
  }

  // ---- what is seen of it

  redraw() {
    if (!this.panels.a.drawing || !this.panels.b.drawing) return;
    for (const panel of Object.values(this.panels)) {
      const chosen = this.held?.panel === panel && this.tool === "pair" ? [this.held.what.number] : [];
      panel.light(chosen, this.lit(panel));
      at(`count-${panel.side}`).textContent = this.caption(panel);
      panel.mark(...this.marks(panel));
    }
    this.line();
  }

  get current() {
    if (this.pointed) return this.pointed;
    if (!this.isByKeys) return null;
    const panel = Object.values(this.panels).find(({ canvas }) => canvas === document.activeElement);
    return panel ? { panel, number: this.at(panel).number, spot: { at: this.at(panel).at } } : null;
  }

  // Which part is pointed at, and what becomes of it; else how many there are.
  caption(panel) {
    const { current } = this;
    if (current?.number === undefined) return counted(panel.contours.length, "part");
    const isOwn = current.panel === panel;
    const numbers = isOwn ? [current.number] : this.app.partners(current.panel.side, current.number);
    const isAlone = isOwn && !this.app.partners(panel.side, current.number).length;
    const names = numbers.map((number) => panel.nameOf(number));
    return (names.join(", ") || "no part") + (isAlone ? ", alone" : "");
  }

  lit(panel) {
    const { current } = this;
    if (this.tool !== "pair" || !current) return [];
    return current.panel === panel ? [current.number] : this.app.partners(current.panel.side, current.number);
  }

  marks(panel) {
    const marks = [];
    const side = panel.side === "a" ? 0 : 1;
    if (panel.side === "a") {
      const regions = (this.app.get("stiff") ?? []).map(regionOf);
      const path = this.tool === "stiff" ? (this.drag?.path ?? this.held?.path) : null;
      if (path) regions.push(middle(path));
      for (const { centre, radius } of regions) {
        marks.push(drawn("circle", { class: "stiff", cx: centre[0], cy: centre[1], r: Math.max(radius, 3 / panel.scale) }));
      }
    }
    if (this.tool === "pin" || (this.tool === "stiff" && panel.side === "a")) marks.push(...panel.nodes());
    if (this.tool === "pin") marks.push(...this.goesWhere(panel));
    for (const [k, text] of (this.app.get("pin") ?? []).entries()) {
      const points = pointsOf(text);
      if (!points || this.drag?.pin?.index === k) continue;
      const isPicked = this.picked?.index === k && this.picked.side === panel.side;
      marks.push(panel.dot(points[side], isPicked ? 10 : 7, { class: isPicked ? "pin picked" : "pin" }), panel.number(points[side], k + 1));
    }
    const ends = [];
    if (this.drag && this.tool === "pin") {
      ends.push(this.drag.from);
      if (this.drag.to) ends.push({ panel: this.other(this.drag.from.panel), spot: this.drag.to });
    } else if (this.held && this.tool !== "pair") {
      ends.push({ panel: this.held.panel, spot: this.held.what });
    }
    const { current } = this;
    if (this.tool !== "pair" && current?.spot && !this.drag) ends.push({ ...current, isCursor: true });
    for (const { panel: one, spot, isCursor } of ends) {
      if (one === panel) marks.push(panel.dot(spot.at, isCursor ? 6 : 8, { class: isCursor ? "cursor" : "end" }));
    }
    return marks;
  }

  // Places of the part at hand, each in the colour of the place where it goes.
  goesWhere(panel) {
    const place = this.current ?? (this.drag ? { panel: this.drag.from.panel, number: this.drag.from.spot.number } : null);
    if (!place || place.number === undefined) return [];
    const shown = this.app.correspondence(place.panel.side, place.number);
    return shown.flatMap((points) => {
      const step = Math.max(1, Math.floor(points.length / SHOWN));
      const some = points.filter((_, k) => k % step === 0);
      return some.map((ends, k) => panel.dot(ends[panel.side === "a" ? 0 : 1], panel.dotSize, { class: "goes", fill: hue(k, some.length) }));
    });
  }

  // From one drawing into the other: what is being dragged.
  line() {
    const across = at("across");
    const { left, top } = across.getBoundingClientRect();
    const ends = [];
    if (this.drag?.moved && this.tool === "pin") {
      const { from, to, event } = this.drag;
      ends.push(from.panel.onScreen(from.spot.at), to ? this.other(from.panel).onScreen(to.at) : [event.clientX, event.clientY]);
    }
    if (!ends.length) {
      across.replaceChildren();
      return;
    }
    const d = `M${ends.map(([x, y]) => `${x - left} ${y - top}`).join("L")}`;
    across.replaceChildren(drawn("path", { class: "halo", d }), drawn("path", { class: "thread", d }));
  }
}
