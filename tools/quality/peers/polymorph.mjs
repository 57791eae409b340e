// A job has `a` and `b`, path data, and `precision`, how many decimals it writes.
import { interpolate } from 'polymorph-js';

// At 0 and 1 it gives the drawings as they came.
const NEAR = 1e-6;

export function blend({ a, b, precision }) {
  const at = interpolate([a, b], { precision });
  return (t) => at(Math.min(Math.max(t, NEAR), 1 - NEAR));
}
