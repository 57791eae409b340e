// A blend of drawings, made by shapeblend. Times are shares of the way, from 0 to 1.
//   <script type="module" src="FILE"></script>  <shape-blend autoplay loop></shape-blend>
//   import { animate, at, define, ease, interpolate, mount } from "./FILE";
const drawing = /*DRAWING*/, sizes = /*SIZES*/, stops = /*EASING*/, digits = /*DIGITS*/;
/** Milliseconds from the first drawing to the last. */
export const duration = /*MILLISECONDS*/;

const NUMBER = /-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?/gi, OPAQUE = /^#(..)(..)(..)$/;
const known = new Map();

// The texts around numbers, the numbers, and their decimals.
const parsed = (text) => {
  if (!known.has(text)) {
    const [, ...pairs] = OPAQUE.exec(text) ?? [];
    known.set(text, pairs.length
      ? [["rgb(", ",", ",", ")"], pairs.map((pair) => parseInt(pair, 16)), 0]
      : [text.split(NUMBER), (text.match(NUMBER) ?? []).map(Number), digits]);
  }
  return known.get(text);
};

const between = (from, to, share) => {
  if (from === to || share <= 0) return from;
  const [texts, starts, places] = parsed(from), ends = parsed(to)[1];
  if (share >= 1 || starts.length !== ends.length || !starts.length) return share < 0.5 ? from : to;
  return starts.reduce((found, start, k) =>
    found + +(start + share * (ends[k] - start)).toFixed(places) + (texts[k + 1] || " "), texts[0]).trim();
};

const clamped = (t, most = 1) => Math.min(Math.max(Number(t) || 0, 0), most);
const place = (times, t) => clamped(times.findLastIndex((time) => time <= t), times.length - 2);
const way = (start, end, t) => t < end ? (t - start) / (end - start) : 1;

// Of values, their times unless even, and whether they jump.
const valueAt = ([, values, times, jumps], t) => {
  times ||= values.map((_, k) => k / (values.length - 1));
  const k = place(times, t), share = way(times[k], times[k + 1], t);
  return between(values[k], values[k + 1], jumps ? share === 1 : share);
};

const attributesAt = ([, given, moves], t) => {
  const found = { ...given };
  for (const move of moves) {
    const [name, , , , kind] = move, value = valueAt(move, t);
    found[name] = kind ? (kind === "translate" ? "" : found[name] + " ") + `${kind}(${value})` : value;
  }
  return found;
};

/** The attributes of each path, the lowest first. @param {number} t @returns {Record<string, string>[]} */
export function at(t) {
  const found = [];
  const add = (node) => {
    const attributes = attributesAt(node, clamped(t));
    if (node[0] === "path" && attributes.visibility !== "hidden") found.push(attributes);
    else if (node[0] === "svg" || node[0] === "g") node[3].forEach(add);
  };
  add(drawing);
  return found;
}

/** Path data of one path of `at`. @returns {(t: number) => string} */
export const interpolate = (shape = 0) => (/** @type {number} */ t) => at(t)[shape]?.d ?? "";

/** Progress after a share of the time. @returns {number} */
export function ease(time) {
  const k = place(stops.map(([x]) => x), time), [[start, from], [end, to]] = stops.slice(k);
  return from + way(start, end, time) * (to - from);
}

let count = 0;

/** Draw into an svg element, and return what shows a time. @param {SVGSVGElement} svg @returns {(t: number) => void} */
export function mount(svg) {
  const suffix = `-${++count}`, moving = [];
  const own = (name, value) =>
    name === "id" ? value + suffix : value.replace(/url\(#([^)]+)\)/, (_, id) => `url(#${id}${suffix})`);
  const show = (element, node, t) => {
    for (const [name, value] of Object.entries(attributesAt(node, t))) element.setAttribute(name, own(name, value));
  };
  const fill = (element, node) => {
    show(element, node, 0);
    if (node[2].length) moving.push([element, node]);
    if (typeof node[3] === "string") element.textContent = node[3];
    else element.replaceChildren(...node[3].map((child) =>
      fill(document.createElementNS("http://www.w3.org/2000/svg", child[0]), child)));
    return element;
  };
  fill(svg, drawing);
  // A size in CSS stays, too.
  if (!svg.matches("[width],[height]")) {
    for (const [name, size] of sizes) svg.setAttribute(name, size);
    if (sizes.some(([name]) => Math.abs(parseFloat(getComputedStyle(svg)[name]) - svg[name].baseVal.value) >= 1))
      for (const [name] of sizes) svg.removeAttribute(name);
  }
  return (t) => moving.forEach(([element, node]) => show(element, node, clamped(t)));
}

/** A blend that plays. Events: "update", "loop" and "finish". */
export class Player extends (globalThis.EventTarget ?? Object) {
  #show; #frame = 0; #last = 0; #way = 1; #runs = 0;
  time = 0;

  /** @param {{duration?: number, easing?: (t: number) => number, loop?: boolean | number, alternate?: boolean}} options */
  constructor(show, options = {}) {
    super();
    this.#show = show;
    this.options = { duration, easing: ease, loop: false, alternate: false, ...options };
  }

  get playing() { return this.#frame > 0; }

  /** Go on, or begin again; at once to the end where motion is to be reduced. */
  play() {
    const end = this.#way > 0 ? 1 : 0;
    if (this.time === end) this.time = 1 - end;
    this.#runs = 0;
    if (globalThis.matchMedia?.("(prefers-reduced-motion: reduce)").matches) {
      this.seek(end);
      this.#tell("finish");
    } else if (!this.playing) {
      this.#last = 0;
      this.#frame = requestAnimationFrame((now) => this.#step(now));
    }
    return this;
  }

  pause() {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    return this;
  }

  reverse() {
    this.#way = -this.#way;
    return this.play();
  }

  /** Go on to 0 or 1. */
  to(end = 1) {
    this.#way = end ? 1 : -1;
    return this.time === end ? this : this.play();
  }

  seek(time) {
    this.time = clamped(time);
    this.#show(this.options.easing(this.time));
    this.#tell("update");
    return this;
  }

  #tell(name) { this.dispatchEvent(new Event(name)); }

  #step(now) {
    const { duration: whole, loop, alternate } = this.options;
    const time = this.time + (this.#last ? (this.#way * (now - this.#last)) / Math.max(whole, 1) : 0);
    this.#last = now;
    this.#frame = requestAnimationFrame((then) => this.#step(then));
    this.seek(time);
    if (time > 0 && time < 1 || (time <= 0) === (this.#way > 0)) return;
    this.#runs += 1;
    if (loop !== true && this.#runs >= (loop || (alternate ? 2 : 1))) {
      this.pause();
      this.#tell("finish");
    } else {
      if (alternate) this.#way = -this.#way;
      else this.time = this.#way > 0 ? 0 : 1;
      this.#tell("loop");
    }
  }
}

/** Draw into an svg element. @param {ConstructorParameters<typeof Player>[1]} [options] */
export const animate = (svg, options) => new Player(mount(svg), options);

/** Define an element: attributes autoplay, loop, alternate, duration; property player. */
export function define(name = "shape-blend") {
  customElements.define(name, class extends HTMLElement {
    connectedCallback() {
      if (this.player) return;
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      this.attachShadow({ mode: "open" }).append(svg);
      const [loop, alternate] = ["loop", "alternate"].map((each) => this.hasAttribute(each));
      this.player = animate(svg, { duration: +this.getAttribute("duration") || duration, loop, alternate });
      svg.style.cssText = "display:block;width:100%;height:100%";
      this.style.display ||= "inline-block";
      if (this.hasAttribute("autoplay")) this.player.play();
    }

    disconnectedCallback() { this.player?.pause(); }
  });
}

if (globalThis.customElements && !customElements.get("shape-blend")) define();
