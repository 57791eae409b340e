// A custom element of several states, made by shapeblend. It needs nothing else. In a JavaScript module:
//   import "./FILE";
// and in the page:
//   <ELEMENT state="STATE"></ELEMENT>
// Attributes: state; trigger="click" or "hover"; label, which screen readers are told.
// Properties: state, states; next() goes on to the next state. Each change fires "statechange".
const sheet = new CSSStyleSheet();
sheet.replaceSync(":host{display:inline-block}svg{display:block;width:100%;height:100%}" + /*STYLE*/);
const states = /*STATES*/, body = /*BODY*/, title = /*TITLE*/, milliseconds = /*MILLISECONDS*/;
const moves = CSS.supports("d", 'path("M0 0")');
const reduced = matchMedia("(prefers-reduced-motion: reduce)");
const template = document.createElement("template");
template.innerHTML = body;

class States extends HTMLElement {
  static observedAttributes = ["state", "trigger", "label"];

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [sheet];
    root.append(template.content.cloneNode(true));
    this.drawing = root.querySelector("svg");
    this.addEventListener("click", () => this.trigger === "click" && this.next());
    this.addEventListener("keydown", (event) => {
      if (this.trigger === "click" && /^( |Enter)$/.test(event.key)) {
        event.preventDefault();
        this.next();
      }
    });
    const rest = { pointerenter: 1, focus: 1, pointerleave: 0, blur: 0 };
    for (const [name, k] of Object.entries(rest)) {
      this.addEventListener(name, () => {
        if (this.trigger === "hover" && (name !== "focus" || this.matches(":focus-visible"))) this.state = states[k];
      });
    }
  }

  get states() {
    return [...states];
  }

  get state() {
    const state = this.getAttribute("state");
    return states.includes(state) ? state : states[0];
  }

  set state(state) {
    this.setAttribute("state", state);
  }

  get trigger() {
    return this.getAttribute("trigger");
  }

  next() {
    this.state = states[(states.indexOf(this.state) + 1) % states.length];
  }

  connectedCallback() {
    this.update();
  }

  attributeChangedCallback() {
    if (this.isConnected) this.update();
  }

  update() {
    const label = this.getAttribute("label") || title;
    this.setAttribute("role", this.trigger === "click" ? "button" : "img");
    this.setAttribute("aria-label", `${label}: ${this.state}`);
    if (this.trigger && !this.hasAttribute("tabindex")) this.tabIndex = 0;
    if (this.drawing.dataset.state === this.state) return;
    this.drawing.dataset.state = this.state;
    if (!moves) this.go();
    this.dispatchEvent(new CustomEvent("statechange", { bubbles: true, detail: this.state }));
  }

  // Where paths have no transitions of their own: number by number, from what is there.
  go() {
    cancelAnimationFrame(this.frame);
    const wanted = [...this.drawing.querySelectorAll("[data-d]")].map((path) => {
      const ends = [path.getAttribute("d"), JSON.parse(path.dataset.d)[states.indexOf(this.state)]];
      return [path, ...ends.map((d) => d.match(/[a-z]|-?[\d.]+/gi))];
    });
    const begin = performance.now();
    const step = (now) => {
      const t = reduced.matches ? 1 : Math.min(1, (now - begin) / milliseconds);
      for (const [path, from, to] of wanted) {
        path.setAttribute("d", to.map((v, k) => (isNaN(v) ? v : (1 - t) * from[k] + t * v)).join(" "));
      }
      if (t < 1) this.frame = requestAnimationFrame(step);
    };
    step(begin);
  }
}

customElements.define(/*NAME*/, States);
