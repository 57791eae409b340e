// Fields for options: what moves, the constants of the wire, all others, and export.

import { at, figures, made } from "./values.js";
import { EasingCurve } from "./easing.js";

// Sliders of constants: how far they go, whether by factors, and what they are called.
const CONSTANTS = [
  { name: "kb", says: "Bending", default: 1, by: "factor" },
  { name: "ks", says: "Stretching", default: 1.2, by: "factor" },
  { name: "kt", says: "Staying near", default: 7, by: "factor" },
  { name: "cs", says: "Collapsing", low: 0.02, high: 1, step: 0.02 },
  { name: "smoothing", says: "Smoothing", low: 0, high: 0.1, step: 0.002 },
];
const DECADES = 1.5;
const SHORT = 26; // letters of a default that fit into a field
const OF_FORMAT = { width: "Width, pixels", fps: "Pictures a second", columns: "Columns", background: "Background", lossless: "Lossless" };
const STARTS = { load: "by itself", click: "on a click", hover: "under the pointer" };
const ELSEWHERE = new Set(["pin", "match", "stiff", "motion", "ease", "duration", "hold", "repeat", "timing", "stagger", "stagger-by", "output", "frames", "emit", "format", ...Object.keys(OF_FORMAT)]);

export class Form {
  // `app` has the options and takes changes: get, change, attempt.
  constructor(app, { options, formats, words, default: name }) {
    Object.assign(this, { app, formats, words, name, fields: [], inputs: new Map() });
    this.options = new Map(options.map((option) => [option.name, option]));
    this.moves();
    this.wire();
    this.others();
    this.exports();
    for (const [option, id] of Object.entries({ ease: "ease-text", hold: "hold-a" })) this.inputs.set(option, at(id));
    for (const option of ["motion", "duration", "repeat", "stagger", "output", "frames", "format"]) this.inputs.set(option, at(option));
  }

  // Marks the field of the option that something is wrong with, if any; returns whether the name is one of an option.
  mark(name) {
    for (const input of this.inputs.values()) input.removeAttribute("aria-invalid");
    const field = this.inputs.get(name);
    field?.setAttribute("aria-invalid", "true");
    if (field?.offsetParent) field.scrollIntoView({ block: "nearest" });
    return this.options.has(name);
  }

  set(name, value, what = name) {
    const option = this.options.get(name);
    const isDefault = value === null || value === "" || (option?.default === String(value) && option.kind === "choice");
    this.app.change({ [name]: isDefault ? null : value }, what);
  }

  moves() {
    const { choices } = this.options.get("motion");
    at("motion").append(...choices.map((word) => made("option", { value: word }, word)));
    at("stagger-by").append(...this.options.get("stagger-by").choices.map((word) => made("option", { value: word }, word)));
    at("ease").append(...this.words.ease.map((word) => made("option", { value: word }, word)));
    at("trigger").append(...this.words.trigger.map((word) => made("option", { value: word }, STARTS[word] ?? word)));
    at("trigger").addEventListener("change", () => this.set("trigger", at("trigger").value === "load" ? null : at("trigger").value));
    at("repeat").append(...["forever", "pingpong", "1", "2", "3"].map((word) => made("option", { value: word }, word === "1" ? "once" : Number(word) ? `${word} times` : word)));
    at("motion").addEventListener("change", () => this.set("motion", at("motion").value));
    const ease = (text) => this.set("ease", text === "linear" ? null : text, "easing");
    at("ease").addEventListener("change", () => ease(at("ease").value));
    at("ease-text").addEventListener("change", () => ease(at("ease-text").value.trim() || "linear"));
    this.curve = new EasingCurve(at("curve"), (text, isDone) => {
      at("ease-text").value = text;
      if (isDone) ease(text);
    });
    at("repeat").addEventListener("change", () => this.set("repeat", at("repeat").value === "forever" ? null : at("repeat").value));
    const duration = at("duration");
    duration.addEventListener("input", () => (at("duration-says").textContent = `${duration.value} s`));
    duration.addEventListener("change", () => this.set("duration", Number(duration.value) === 2 ? null : Number(duration.value)));
    const rests = ["a", "b"].map((side) => at(`hold-${side}`));
    for (const input of rests) {
      input.addEventListener("change", () => {
        const [first, other] = rests.map(({ value }) => Number(value));
        this.set("hold", first || other ? `${first},${other}` : null, "rest");
      });
    }
    this.fields.push((answer) => {
      const hold = (this.app.get("hold") ?? "0,0").split(",").map(Number);
      rests.forEach((input, k) => document.activeElement === input || (input.value = hold[k] || ""));
      const easing = this.app.get("ease") ?? "linear";
      this.curve.show(easing, answer?.timing.ease);
      if (document.activeElement !== at("ease-text")) at("ease-text").value = easing;
      choose(at("motion"), this.app.get("motion") ?? "auto");
      choose(at("ease"), easing);
      choose(at("trigger"), this.app.get("trigger") ?? "load");
      choose(at("repeat"), String(this.app.get("repeat") ?? "forever"));
      duration.value = this.app.get("duration") ?? 2;
      at("duration-says").textContent = `${this.app.get("duration") ?? 2} s`;
    });
  }

  wire() {
    for (const constant of CONSTANTS) {
      const id = `constant-${constant.name}`;
      const isFactor = constant.by === "factor";
      const limits = isFactor ? { min: -DECADES, max: DECADES, step: 0.05 } : { min: constant.low, max: constant.high, step: constant.step };
      const input = made("input", { id, type: "range", ...limits });
      const says = made("output", { for: id });
      const value = () => Number(figures(isFactor ? constant.default * 10 ** input.value : Number(input.value), 3));
      const show = (number) => (says.textContent = figures(number, 3));
      input.addEventListener("input", () => {
        show(value());
        this.app.attempt({ [constant.name]: value() });
      });
      input.addEventListener("change", () => this.app.change({ [constant.name]: value() }, constant.says.toLowerCase()));
      at("constants").append(made("label", { for: id, title: this.options.get(constant.name).help }, constant.says), made("span", { class: "slide" }, input, says));
      this.fields.push((answer) => {
        const number = Number(this.app.get(constant.name) ?? answer?.settings[constant.name]);
        if (!Number.isFinite(number) || document.activeElement === input) return;
        input.value = isFactor ? Math.log10(Math.max(number, 1e-6) / constant.default) : number;
        show(number);
      });
    }
    at("constants-reset").addEventListener("click", () =>
      this.app.change(Object.fromEntries(CONSTANTS.map(({ name }) => [name, null])), "constants"));
  }

  // Every option that has no place of its own, as the command has it.
  others() {
    const sections = new Map();
    for (const option of this.options.values()) {
      if (ELSEWHERE.has(option.name)) continue;
      if (!sections.has(option.section)) sections.set(option.section, []);
      sections.get(option.section).push(option);
    }
    const rows = [];
    for (const [title, options] of sections) {
      const fields = options.map((option) => this.row(option));
      const section = made("section", {}, made("h3", {}, title), ...fields.map(({ element }) => element));
      at("all").append(section);
      rows.push(...fields.map((field) => ({ ...field, section })));
    }
    at("find").addEventListener("input", () => {
      const words = at("find").value.toLowerCase().split(/\s+/);
      for (const { element, text } of rows) element.hidden = !words.every((word) => text.includes(word));
      for (const { section } of rows) section.hidden = rows.every((row) => row.section !== section || row.element.hidden);
      at("none-found").hidden = rows.some(({ element }) => !element.hidden);
    });
  }

  // An option as the command has it, with what it does.
  row(option) {
    const id = `option-${option.name}`;
    const input = this.field(option, id);
    input.setAttribute("aria-describedby", `${id}-help`);
    const ends = option.default.length > SHORT ? ` By default ${option.default}.` : "";
    const help = made("p", { id: `${id}-help`, class: "quiet small" }, option.help + ends);
    const element = made("div", { class: "fields" }, made("label", { for: id }, `--${option.name}`), input, help);
    return { element, text: `--${option.name} ${option.section} ${option.help} ${option.choices.join(" ")}`.toLowerCase() };
  }

  field(option, id) {
    const { name, kind } = option;
    let input;
    if (kind === "choice") {
      const first = made("option", { value: "" }, option.default ? `${option.default} (default)` : "default");
      const others = option.choices.filter((word) => word !== option.default);
      input = made("select", { id }, first, ...others.map((word) => made("option", { value: word }, word)));
    } else if (kind === "flag") {
      input = made("select", { id }, made("option", { value: "" }, `${option.default || "no"} (default)`));
      const words = option.no ? [name, option.no].filter((word) => word !== option.default) : [name];
      input.append(...words.map((word) => made("option", { value: word }, option.no ? word : "yes")));
    } else {
      const shown = option.default.length > SHORT ? "" : option.default;
      input = made("input", { id, type: "text", placeholder: shown || option.metavar, inputmode: kind === "number" ? "decimal" : "text", spellcheck: "false", autocomplete: "off" });
      if (this.words[name]) {
        const list = made("datalist", { id: `${id}-words` }, ...this.words[name].map((word) => made("option", { value: word })));
        input.setAttribute("list", list.id);
        at("all").append(list);
      }
    }
    input.addEventListener("change", () => {
      const text = input.value.trim();
      if (kind === "flag") {
        this.app.change({ [name]: null, ...(option.no ? { [option.no]: null } : {}), ...(text ? { [text]: true } : {}) }, name);
      } else if (option.many) {
        this.set(name, text ? text.split(/\s*;\s*/) : null);
      } else {
        this.set(name, text === "" ? null : text);
      }
    });
    this.fields.push(() => {
      if (document.activeElement === input && kind !== "choice" && kind !== "flag") return;
      const value = this.app.get(name);
      if (kind === "flag") input.value = [name, option.no].find((word) => word && word !== option.default && this.app.get(word)) ?? "";
      else if (kind === "choice") input.value = value === undefined || value === option.default ? "" : String(value);
      else input.value = value === undefined ? "" : Array.isArray(value) ? value.join("; ") : String(value);
    });
    this.inputs.set(name, input);
    return input;
  }

  exports() {
    at("format").append(...this.formats.map((format, k) => made("option", { value: k, title: format.help }, titleOf(format))));
    at("format").addEventListener("change", () => {
      const { options, takes, takes_triggers: takesTriggers } = this.formats[Number(at("format").value)];
      const others = Object.keys(OF_FORMAT).filter((name) => !(name in takes));
      const old = this.app.get("output") ?? this.name;
      const stem = this.formats.map((format) => format.suffix).filter(Boolean)
        .reduce((text, each) => (text.toLowerCase().endsWith(each) ? text.slice(0, -each.length) : text), old);
      this.app.change({ emit: null, format: null, ...Object.fromEntries(others.map((name) => [name, null])), ...(takesTriggers ? {} : { trigger: null }), ...options, output: this.named(stem) }, "format");
    });
    const own = Object.entries(OF_FORMAT).map(([name, text]) => {
      const option = this.options.get(name);
      const id = `option-${name}`;
      const parts = [made("label", { for: id, title: option.help }, text), this.field({ ...option, default: "" }, id)];
      at("of-format").append(...parts);
      return { name, parts };
    });
    at("output").addEventListener("change", () => {
      at("output").value = at("output").value.trim() || this.named(this.name);
      this.set("output", at("output").value, "name");
    });
    at("frames").addEventListener("change", () => this.set("frames", at("frames").value === "" ? null : Number(at("frames").value), "number of in-betweens"));
    this.fields.push((answer) => {
      const output = this.app.get("output") ?? this.name;
      at("output").value = output;
      at("format").value = this.formatOf(output.toLowerCase());
      const { has_frames: hasFrames, takes, takes_triggers: takesTriggers } = this.formats[Number(at("format").value)];
      at("trigger").disabled = !takesTriggers && this.app.get("trigger") === undefined;
      for (const { name, parts } of own) {
        for (const part of parts) part.hidden = !(name in takes) && this.app.get(name) === undefined;
        if (name in takes) parts[1].placeholder = takes[name] || "by their number";
      }
      for (const name of ["frames", "frames-label"]) at(name).hidden = !hasFrames && this.app.get("animate") !== "frames";
      at("frames").value = this.app.get("frames") ?? "";
      at("frames").placeholder = answer?.frames ?? "";
    });
  }

  // The name of a file in the format that is chosen; it is not that of the project.
  named(stem) {
    const { name, suffix } = this.formats[Number(at("format").value)];
    return stem + suffix === at("project").value ? `${stem}.${name}${suffix}` : stem + suffix;
  }

  // The number of the format that the options ask for.
  formatOf(output) {
    const emit = this.app.get("emit") === "frames" ? undefined : this.app.get("emit");
    const kind = this.app.get("format") === "svg" ? undefined : this.app.get("format");
    const alike = this.formats.map((format, k) => ({ ...format, k })).filter(({ options }) => options.emit === emit);
    const found = alike.find(({ suffix }) => suffix && output.endsWith(suffix)) ?? alike.find(({ suffix, options }) => !suffix && options.format === kind);
    return (found ?? alike[0] ?? { k: 0 }).k;
  }

  // Whether it takes long to know how large the files are.
  get isSlow() {
    return this.formats[Number(at("format").value)].is_raster;
  }

  // Shows what is so now, and of the latest answer what is in force, if there is one.
  show(answer) {
    for (const field of this.fields) field(answer);
  }
}

const WRITTEN = {
  svg: "SVG", png: "PNG", gif: "GIF", webp: "WebP", apng: "APNG", mp4: "MP4", webm: "WebM",
  js: "JavaScript module", avd: "Android vector drawable", lottie: "Lottie", dotlottie: "dotLottie",
};

function titleOf({ name, suffix, options }) {
  const words = name.split(" ").map((word) => WRITTEN[word] ?? word).join(" ");
  const title = name in WRITTEN ? words : words[0].toUpperCase() + words.slice(1);
  if (suffix) return `${title} (${suffix})`;
  return options.emit ? `${title} of SVG files` : `${title} frames, a folder`;
}

// Chooses a word, also one that was not offered.
function choose(select, word) {
  if (![...select.options].some(({ value }) => value === word)) select.append(made("option", { value: word }, word));
  select.value = word;
}
