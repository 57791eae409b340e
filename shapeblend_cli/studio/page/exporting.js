// What is written and kept: the blend in a format, and the project.

import { at, figures } from "./values.js";
import { ask, keep, Latest } from "./asking.js";

const QUIET = 900; // milliseconds without a change before sizes are measured

const sizeOf = (bytes) => (bytes < 1e6 ? `${figures(bytes / 1e3, 3)} kB` : `${figures(bytes / 1e6, 3)} MB`);

const labelOf = ({ existing }) => (existing.length ? "Replace what is there" : "Write there");
const questionOf = ({ outside, existing }) => [
  ...(outside.length ? [`Not in the folder of this project: ${outside.join(", ")}.`] : []),
  ...(existing.length ? [`There already: ${existing.join(", ")}.`] : []),
].join(" ");

export class Exporting {
  // `app` has the project, and takes note of one that was saved.
  constructor(app, folder) {
    Object.assign(this, { app, folder, timer: 0 });
    this.sizes = new Latest((project) => this.measure(project));
    at("write").addEventListener("click", () => this.write());
    at("save").addEventListener("click", () => this.save());
    at("download").addEventListener("click", () => this.tell(async () => `${await keep("download", { project: app.project() })} is in the browser's downloads.`));
    at("keep").addEventListener("click", () => this.keep());
  }

  async tell(work) {
    at("replace").hidden = true;
    at("written").textContent = "Working…";
    try {
      at("written").textContent = await work();
    } catch (error) {
      at("written").textContent = this.app.isComplaint(error.message) ? "Nothing was written." : error.message;
    }
  }

  // Writes files; of those that were not agreed to, asks whether to.
  write(agreed = []) {
    return this.tell(async () => {
      const { asks, written, notes } = await ask("write", { project: this.app.project(), agreed });
      if (asks) {
        at("replace").textContent = labelOf(asks);
        at("replace").onclick = () => this.write([...agreed, ...asks.outside, ...asks.existing]);
        at("replace").hidden = false;
        return questionOf(asks);
      }
      return [`Wrote ${written.join(" and ")} in ${this.folder}.`, ...notes].join(" ");
    });
  }

  // Saves the project, and says so where everybody looks: its button is far from the export.
  async save(agreed = []) {
    const project = this.app.project();
    try {
      const { asks, written } = await ask("save", { project, agreed, file: at("project").value.trim() });
      if (asks) {
        this.app.notice(questionOf(asks), labelOf(asks), () => this.save([...agreed, ...asks.outside, ...asks.existing]));
        return;
      }
      this.app.saved(project);
      this.app.notice(`Saved ${written.join(" and ")} in ${this.folder}.`);
    } catch (error) {
      this.app.notice(null);
      this.app.complain(error.message);
    }
  }

  async keep() {
    const project = this.app.project();
    try {
      const name = await keep("keep", { project });
      this.app.saved(project);
      this.app.notice(`${name} is in the browser's downloads; keep it beside the drawings.`);
    } catch (error) {
      this.app.complain(error.message);
    }
  }

  // Tells how large the files would be, once nothing changes any more.
  size(isSlow) {
    clearTimeout(this.timer);
    at("size").textContent = "";
    if (!isSlow) this.timer = setTimeout(() => this.sizes.want(this.app.project()), QUIET);
  }

  async measure(project) {
    try {
      const { files, bytes, gzipped } = await ask("size", { project });
      if (project !== this.app.project()) return;
      at("size").textContent = `${files > 1 ? `${files} files, ` : ""}${sizeOf(bytes)}${gzipped < bytes ? `, ${sizeOf(gzipped)} with gzip` : ""}`;
    } catch {
      // The blend says what is wrong.
    }
  }
}
