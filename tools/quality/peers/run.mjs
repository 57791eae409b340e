// Blends with one of the libraries beside this file: node run.mjs NAME.
//
// A job is a line on standard input, an answer a line on standard output, both JSON. A job has what the library's own
// script asks for, and `times`. An answer is {frames}, path data at each time, or {error}.
import { createInterface } from 'node:readline';

const { blend } = await import(`./${process.argv[2]}.mjs`);

for await (const line of createInterface({ input: process.stdin })) {
  let said;
  try {
    const job = JSON.parse(line);
    said = { frames: job.times.map(blend(job)) };
  } catch (error) {
    said = { error: String(error) };
  }
  process.stdout.write(`${JSON.stringify(said)}\n`);
}
