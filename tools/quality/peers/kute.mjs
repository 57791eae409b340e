// A job has `a` and `b`, lists of path data with one contour each, of equal length; and `side`, the longest side of a
// polygon, or `curves`: true for the component that blends curves.
//
// The library's bundle has no component for curves, so both are taken from its sources. These name each other
// without a suffix, which bundlers allow and node does not: the hook adds it.
import { register } from 'node:module';

const hook = `export async function resolve(name, context, next) {
  return next(/^[.].*[/][^.]+$/.test(name) ? name + '.js' : name, context);
}`;
register(`data:text/javascript,${encodeURIComponent(hook)}`);
const { default: polygons } = await import('kute.js/src/components/svgMorph.js');
const { default: curves } = await import('kute.js/src/components/svgCubicMorph.js');
const { default: updates } = await import('kute.js/src/objects/kute.js');

const property = 'path';

// What a tween does with path data when it is made. For polygons the function is asked that it calls: a tween cuts a
// side to a whole number, and knows the component's own only once that is registered.
function ends(component, a, b, side) {
  const tween = { valuesStart: { path: { original: a } }, valuesEnd: { path: { original: b } } };
  if (component === curves) {
    component.functions.crossCheck.call(tween, property);
  } else {
    const [first, last] = component.Util.getInterpolationPoints(a, b, side);
    tween.valuesStart.path.polygon = first;
    tween.valuesEnd.path.polygon = last;
  }
  return tween;
}

export function blend(job) {
  const component = job.curves ? curves : polygons;
  const tweens = job.a.map((a, k) => ends(component, a, job.b[k], job.side));
  delete updates[property];
  component.functions.onStart.call(tweens[0], property);
  return (t) => {
    const drawn = [];
    const element = { setAttribute: (_, data) => drawn.push(data) };
    // At 1 it gives the drawing as it came.
    const time = Math.min(t, 1 - 1e-9);
    for (const tween of tweens) updates[property](element, tween.valuesStart.path, tween.valuesEnd.path, time);
    return drawn.join('');
  };
}
