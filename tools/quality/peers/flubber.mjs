// A job has `a` and `b`, lists of path data with one contour each, of equal length or one of them with a single
// contour; and `side`, the longest side of a polygon.
import flubber from 'flubber';

// Each answer of the library is a function from time to a ring of points.
function rings({ a, b, side }) {
  const options = { string: false, single: false, maxSegmentLength: side };
  if (a.length === 1 && b.length === 1) return [flubber.interpolate(a[0], b[0], options)];
  if (a.length === b.length) return flubber.interpolateAll(a, b, options);
  return a.length === 1 ? flubber.separate(a[0], b, options) : flubber.combine(a, b[0], options);
}

export function blend(job) {
  const at = rings(job);
  return (t) => at.map((ring) => flubber.toPathString(ring(t))).join('');
}
