// Other blends of the two drawings, to choose from.

import { at, made } from "./values.js";
import { ask } from "./asking.js";

const QUIET = 700; // milliseconds without a change before other blends are looked for

export class Others {
  constructor(app) {
    Object.assign(this, { app, timer: 0, asked: null, files: "" });
  }

  // Looks for those of the present project, once nothing changes any more.
  look() {
    clearTimeout(this.timer);
    const project = this.app.project();
    const files = JSON.stringify(project.files);
    const isWanted = at("others-card").open && this.app.isPair();
    if (!isWanted || files !== this.files) at("others").replaceChildren(); // they are of other drawings
    this.files = files;
    at("others-card").hidden = !this.app.isPair();
    if (!isWanted) return;
    at("others").setAttribute("aria-busy", "true");
    at("others-says").textContent = "Looking for other blends…";
    this.timer = setTimeout(() => this.ask(project), QUIET);
  }

  async ask(project) {
    if (this.asked) return; // looked for again when that is done
    this.asked = project;
    const isPresent = () => project === this.app.project();
    try {
      const { others } = await ask("others", { project });
      if (isPresent()) this.show(others);
    } catch (error) {
      if (isPresent()) {
        at("others-says").textContent = this.app.isComplaint(error.message) ? "There are none as long as the blend cannot be made." : error.message;
        at("others").replaceChildren();
      }
    } finally {
      this.asked = null;
      at("others").removeAttribute("aria-busy");
      if (!isPresent()) this.look();
    }
  }

  show(others) {
    at("others-says").textContent = others.length > 1 ? "Each looks different. The number is its grade: 0 is best, 3 worst." : "Nothing else that was tried looks different.";
    at("others").replaceChildren(...others.map(({ name, options, changes, grade, pictures }, k) => {
      const images = pictures.map((svg) => made("img", { src: `data:image/svg+xml,${encodeURIComponent(svg)}`, alt: "" }));
      const button = made("button", { type: "button", "aria-pressed": k === 0, title: options },
        made("span", { class: "pictures" }, ...images),
        made("span", { class: "what" }, made("span", {}, name), made("span", { class: "quiet" }, grade.toFixed(1))));
      button.addEventListener("click", () => Object.keys(changes).length && this.app.change(changes, name));
      return button;
    }));
  }
}
