// The drawings of a project: which there are, and in which order.

import { at, made } from "./values.js";
import { give } from "./asking.js";

// Corrections are of the drawings that were; options stay.
const OF_PLACES = { pin: null, match: null, stiff: null, start: null, timing: null };

// What says which place of A is which of B, the other way round.
const turned = (text) => text.replace(/^(.*?)([:=])(.*)$/, "$3$2$1");
const swapped = (pair) => pair.replace(/^([^,]+),([^,]+)$/, "$2,$1");
const OTHER_STYLE = { a: "b", b: "a" };

// What can be opened.
const isProject = ({ name }) => name.toLowerCase().endsWith(".json");
export const isDrawing = ({ name, type }) => /\.svgz?$/i.test(name) || type === "image/svg+xml";

// A timetable whose shapes by number are those of the other drawing; ids stay.
function timed(text) {
  const other = (name) => name.replace(/^(B?)(\d+)$/, (_, side, number) => (side ? number : `B${number}`));
  return JSON.stringify(Object.fromEntries(Object.entries(JSON.parse(text)).map(([name, span]) => [other(name), span])));
}

const svg = (...elements) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 48 48">${elements.join("")}</svg>`;
const path = (d, fill) => `<path d="${d}" fill="${fill}"/>`;
const lines = (...data) => svg(...data.map((d) => `<path d="${d}" fill="none" stroke="#3b4252" stroke-width="4" stroke-linecap="round"/>`));

// Drawings to try: an icon of an interface, and an animal.
const EXAMPLES = [
  [
    { name: "menu.svg", svg: lines("M10 14H38", "M10 24H38", "M10 34H38") },
    { name: "close.svg", svg: lines("M12 12L36 36", "M36 12L12 36") },
  ],
  [
    { name: "fish.svg", svg: svg(path("M36 24L46 14Q43 24 46 34Z", "#c2571a"), path("M4 25C12 10 30 10 39 24C30 38 12 38 4 25Z", "#ee8a3c"), path("M20 27Q28 22 32 29Q26 34 20 27Z", "#c2571a"), path("M12 19A2.2 2.2 0 1 0 12 23.4A2.2 2.2 0 1 0 12 19Z", "#26303c")) },
    { name: "bird.svg", svg: svg(path("M34 26L47 20Q45 28 38 33Z", "#2f5d8c"), path("M3 19L8 16C9 9 20 8 23 15C27 19 34 20 39 26C34 36 22 39 15 34C10 30 8 25 9 21Z", "#5b9bd5"), path("M18 22Q32 20 35 30Q24 34 18 22Z", "#2f5d8c"), path("M14 13A1.8 1.8 0 1 0 14 16.6A1.8 1.8 0 1 0 14 13Z", "#26303c")) },
  ],
];

export class Drawings {
  // `app` has the options in force and takes changes: get, change, complain.
  constructor(app, dropped) {
    this.app = app;
    this.dropped = new Set(dropped); // drawings that are in no file here
    at("examples").append(...EXAMPLES.map((two) => {
      const images = two.map(({ svg }) => made("img", { src: `data:image/svg+xml,${encodeURIComponent(svg)}`, alt: "" }));
      const button = made("button", { type: "button" }, made("span", {}, images[0], "→", images[1]), two.map(({ name }) => name.slice(0, -4)).join(" to "));
      button.addEventListener("click", () => this.take(two.map(({ name, svg }) => new File([svg], name))));
      return button;
    }));
    at("swap").addEventListener("click", () => this.swap());
    at("more").addEventListener("change", () => {
      this.take(at("more").files, true);
      at("more").value = "";
    });
    at("add").addEventListener("click", () => at("more").click());
  }

  get files() {
    return this.app.get("files");
  }

  order(files, what) {
    this.app.change({ files, ...OF_PLACES }, what);
  }

  // Opens drawings, in the order in which they come, or a project; adds them to those there are, if that is wanted.
  // What is something else is refused, and so is a single drawing in place of several: all would be gone.
  async take(files, isAdded = false) {
    const projects = [...files].filter(isProject);
    const drawings = [...files].filter((file) => !isProject(file));
    const other = drawings.find((file) => !isDrawing(file));
    try {
      if (other) throw new Error(`${other.name}: neither a drawing, .svg or .svgz, nor a project, .json`);
      if (drawings.length === 1 && !projects.length && !isAdded && this.files.length > 1) {
        throw new Error(`${drawings[0].name}: drawings are open already; dropped onto A or B it takes the place of that one, and two files take the place of all`);
      }
      const names = [];
      for (const file of drawings) names.push(await this.given(file));
      if (projects.length) {
        const { project } = await give("project", projects[0]);
        this.app.open(project);
      } else {
        const kept = isAdded || (names.length === 1 && this.files.length === 1) ? this.files : [];
        this.order([...kept, ...names], "opening of drawings");
      }
      this.app.complain(null);
    } catch (error) {
      this.app.complain(error.message);
    }
  }

  // Gives a drawing to the server, and returns its name there.
  async given(file) {
    const { name, is_here: isHere } = await give("drawing", file);
    if (isHere) this.dropped.delete(name);
    else this.dropped.add(name);
    return name;
  }

  // A single drawing takes the place of another one.
  async replace(place, file) {
    try {
      const files = [...this.files];
      files[place] = await this.given(file);
      this.order(files, "opening of a drawing");
    } catch (error) {
      this.app.complain(error.message);
    }
  }

  // Everything the other way round; a stiff region is of A alone, and of more than two drawings the first has its own rest.
  swap() {
    const { app } = this;
    const each = (name, turn) => (app.get(name) ?? []).map(turn);
    app.change({
      files: [...this.files].reverse(),
      match: each("match", turned),
      pin: each("pin", (text) => (text.includes(":") ? turned(text) : swapped(text))),
      stiff: null,
      start: app.get("start") ? swapped(app.get("start")) : null,
      hold: app.get("hold") && app.isPair() ? swapped(app.get("hold")) : app.get("hold") ?? null,
      timing: app.get("timing") ? timed(app.get("timing")) : null,
      style: OTHER_STYLE[app.get("style")] ?? app.get("style") ?? null,
      "select-a": app.get("select-b") ?? null,
      "select-b": app.get("select-a") ?? null,
    }, "swap");
  }

  show() {
    const { files } = this;
    const absent = files.filter((name) => this.dropped.has(name));
    at("absent").hidden = !absent.length;
    at("absent").textContent = `It expects ${absent.join(" and ")} where it is used.`;
    at("chain").replaceChildren(...files.map((name, k) => {
      const button = (text, label, isOff, order) => {
        const made_ = made("button", { type: "button", class: "plain", "aria-label": `${label} ${name}`, ...(isOff ? { disabled: "" } : {}) }, text);
        made_.addEventListener("click", () => this.order(order(), label.toLowerCase()));
        return made_;
      };
      const earlier = () => files.with(k, files[k - 1]).with(k - 1, name);
      const without = () => files.toSpliced(k, 1);
      return made("li", {}, made("span", { class: "kind" }, String.fromCharCode(65 + (k % 26))), made("span", { class: "what" }, name.split(/[\\/]/).at(-1)),
        button("↑", "Earlier", k === 0, earlier), button("×", "Remove", files.length < 3, without));
    }));
  }
}
