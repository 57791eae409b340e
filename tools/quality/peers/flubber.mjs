// Blends with flubber: a job a line on standard input, an answer a line on standard output, both JSON.
//
// A job has `a` and `b`, lists of path data with one contour each, of equal length or one of them with a
// single contour; `side`, the longest side of a polygon, null for the library's own; `times`; and `strings`,
// whether frames are wanted as the library writes them or as points. An answer is {frames} or {error}.
import { createInterface } from 'node:readline';
import flubber from 'flubber';

// Each answer of the library is a function from time to a ring of points.
function rings({ a, b, side }) {
  const options = { string: false, single: false };
  if (side !== null) options.maxSegmentLength = side;
  if (a.length === 1 && b.length === 1) return [flubber.interpolate(a[0], b[0], options)];
  if (a.length === b.length) return flubber.interpolateAll(a, b, options);
  return a.length === 1 ? flubber.separate(a[0], b, options) : flubber.combine(a, b[0], options);
}

const micro = (value) => Math.round(value * 1e6) / 1e6;

function answer(job) {
  const at = rings(job);
  return job.times.map((t) => {
    const frame = at.map((ring) => ring(t));
    if (job.strings) return frame.map(flubber.toPathString).join('');
    return frame.map((ring) => ring.map(([x, y]) => [micro(x), micro(y)]));
  });
}

for await (const line of createInterface({ input: process.stdin })) {
  let said;
  try {
    said = { frames: answer(JSON.parse(line)) };
  } catch (error) {
    said = { error: String(error) };
  }
  process.stdout.write(`${JSON.stringify(said)}\n`);
}
