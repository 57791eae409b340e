// Requests to the server on this machine.

const TALK = { method: "POST", credentials: "same-origin", cache: "no-store" };

async function answered(response) {
  if (!response.ok) throw new Error(await response.text());
  return response;
}

async function reached(what, options) {
  try {
    return await fetch(`api/${what}`, { ...TALK, ...options });
  } catch {
    throw new Error("The studio does not answer; it may have been ended in its terminal.");
  }
}

function checked(answer) {
  if (answer.error) throw Object.assign(new Error(answer.error), { answer });
  return answer;
}

export async function ask(what, asked = {}) {
  const options = { headers: { "Content-Type": "application/json" }, body: JSON.stringify(asked) };
  return checked(await (await answered(await reached(what, options))).json());
}

export async function give(what, file) {
  const options = { headers: { "Content-Type": "application/octet-stream" }, body: await file.arrayBuffer() };
  return checked(await (await answered(await reached(`${what}?name=${encodeURIComponent(file.name)}`, options))).json());
}

// Has the browser keep a file.
export async function keep(what, asked) {
  const options = { headers: { "Content-Type": "application/json" }, body: JSON.stringify(asked) };
  const response = await answered(await reached(what, options));
  if (response.headers.get("Content-Type").startsWith("application/json")) checked(await response.json());
  const name = decodeURIComponent(response.headers.get("Content-Disposition").split("''")[1]);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await response.blob());
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  return name;
}

// Does one thing at a time; of what is wanted meanwhile only the latest comes next.
export class Latest {
  constructor(work) {
    Object.assign(this, { work, running: false, waiting: null });
  }

  want(value) {
    this.waiting = { value };
    if (!this.running) this.run();
  }

  async run() {
    this.running = true;
    while (this.waiting) {
      const { value } = this.waiting;
      this.waiting = null;
      await this.work(value, () => this.waiting !== null);
    }
    this.running = false;
  }
}
