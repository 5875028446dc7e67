// Arithmetic that gives the same bits as Python's math module and carom's own: exact products and sums.

/** A number of a scene; "inf" is infinity. @param {unknown} value @returns {number} */
export function extended(value) {
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  return typeof value === "number" ? value : NaN;
}

const bits = new DataView(new ArrayBuffer(8));

/** Distance to the next larger number, as math.ulp. @param {number} x */
export function ulp(x) {
  const size = Math.abs(x);
  bits.setFloat64(0, size);
  bits.setBigInt64(0, bits.getBigInt64(0) + 1n);
  return bits.getFloat64(0) - size;
}

/** The product and its rounding error (carom.core.roots.polynomial.two_prod). @param {number} a @param {number} b @returns {[number, number]} */
export function twoProd(a, b) {
  const p = a * b;
  let w = 134217729.0 * a;
  const a1 = w - (w - a);
  const a2 = a - a1;
  w = 134217729.0 * b;
  const b1 = w - (w - b);
  const b2 = b - b1;
  return [p, a2 * b2 - (p - a1 * b1 - a2 * b1 - a1 * b2)];
}

/** The correctly rounded sum, as math.fsum (Shewchuk's partial sums). @param {number[]} numbers */
export function exactSum(numbers) {
  /** @type {number[]} */
  const partials = [];
  for (let x of numbers) {
    let kept = 0;
    for (let y of partials) {
      if (Math.abs(x) < Math.abs(y)) [x, y] = [y, x];
      const high = x + y;
      const low = y - (high - x);
      if (low !== 0) partials[kept++] = low;
      x = high;
    }
    partials.length = kept;
    partials.push(x);
  }
  let n = partials.length - 1;
  let high = partials[n] ?? 0;
  let low = 0;
  while (n > 0 && low === 0) {
    const x = high;
    const y = partials[--n];
    high = x + y;
    low = y - (high - x);
  }
  // halfway cases are rounded to even: what lies below decides
  if (n > 0 && Math.sign(low) === Math.sign(partials[n - 1]) && low !== 0) {
    const y = low * 2;
    const x = high + y;
    if (y === x - high) high = x;
  }
  return high;
}

/** The length of (x, y), correctly rounded as math.dist has it. @param {number} x @param {number} y */
export function length2(x, y) {
  const [xx, ex] = twoProd(x, x);
  const [yy, ey] = twoProd(y, y);
  const sum = Math.max(xx, yy) + Math.min(xx, yy);
  const lost = Math.min(xx, yy) - (sum - Math.max(xx, yy)) + ex + ey;
  const root = Math.sqrt(sum);
  if (!(root > 0)) return root;
  const [square, error] = twoProd(root, root);
  return root + (sum - square - error + lost) / (2 * root);
}

// fdlibm: Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun Microsystems, Inc. business.
// Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved.
const [DEGREE, DEGREE_REST] = [0.017453292519943295, 2.9486522708701687e-19];
const [S1, S2, S3] = [-1.66666666666666324348e-1, 8.33333333332248946124e-3, -1.98412698298579493134e-4];
const [S4, S5, S6] = [2.75573137070700676789e-6, -2.50507602534068634195e-8, 1.58969099521155010221e-10];
const [C1, C2, C3] = [4.16666666666666019037e-2, -1.38888888888741095749e-3, 2.48015872894767294178e-5];
const [C4, C5, C6] = [-2.75573143513906633035e-7, 2.0875723212981748279e-9, -1.13596475577881948265e-11];

/** Cosine and sine of an angle in degrees (carom.core.geometry.angles.direction). @param {number} degrees @returns {[number, number]} */
export function direction(degrees) {
  const turn = degrees % 360;
  const quarters = Math.floor(turn / 90 + 0.5);
  const rest = turn - 90 * quarters;
  const [x, lost] = twoProd(rest, DEGREE);
  const y = lost + rest * DEGREE_REST;
  const z = x * x;
  let w = z * z;
  const v = z * x;
  let r = S2 + z * (S3 + z * S4) + z * w * (S5 + z * S6);
  const s = x - (z * (0.5 * y - v * r) - y - v * S1);
  r = z * (C1 + z * (C2 + z * C3)) + w * w * (C4 + z * (C5 + z * C6));
  const half = 0.5 * z;
  w = 1 - half;
  const c = w + (1 - w - half + (z * r - x * y));
  /** @type {[number, number][]} */
  const found = [[c, s], [0 - s, c], [0 - c, 0 - s], [s, 0 - c]];
  return found[((quarters % 4) + 4) % 4];
}
