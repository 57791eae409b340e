// What is written and kept: the blend in a format, and the project.

import { at, figures } from "./values.js";
import { ask, keep, Latest } from "./asking.js";

const QUIET = 900; // milliseconds without a change before sizes are measured

const sizeOf = (bytes) => (bytes < 1e6 ? `${figures(bytes / 1e3, 3)} kB` : `${figures(bytes / 1e6, 3)} MB`);

export class Exporting {
  // `app` has the project, and takes note of one that was saved.
  constructor(app, folder) {
    Object.assign(this, { app, folder, timer: 0 });
    this.sizes = new Latest((project) => this.measure(project));
    at("write").addEventListener("click", () => this.write("write", () => ({})));
    at("save").addEventListener("click", () => this.write("save", () => ({ file: at("project").value.trim() })));
    at("download").addEventListener("click", () => this.tell(async () => `${await keep("download", { project: app.project() })} is in the browser's downloads.`));
    at("keep").addEventListener("click", () => this.tell(async () => {
      const project = app.project();
      const name = await keep("keep", { project });
      app.saved(project);
      return `${name} is in the browser's downloads; keep it beside the drawings.`;
    }));
  }

  async tell(work) {
    at("replace").hidden = true;
    at("written").textContent = "Working…";
    try {
      at("written").textContent = await work();
    } catch (error) {
      at("written").textContent = error.message;
    }
  }

  // Writes files; of those that were not agreed to, asks whether to.
  write(what, more, agreed = []) {
    return this.tell(async () => {
      const project = this.app.project();
      const { asks, written, notes } = await ask(what, { project, agreed, ...more() });
      if (asks) {
        const { outside, existing } = asks;
        at("replace").textContent = existing.length ? "Replace what is there" : "Write there";
        at("replace").onclick = () => this.write(what, more, [...agreed, ...outside, ...existing]);
        at("replace").hidden = false;
        return [
          ...(outside.length ? [`Not in the folder of this project: ${outside.join(", ")}.`] : []),
          ...(existing.length ? [`There already: ${existing.join(", ")}.`] : []),
        ].join(" ");
      }
      if (what === "save") this.app.saved(project);
      return [`Wrote ${written.join(" and ")} in ${this.folder}.`, ...notes].join(" ");
    });
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
