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

/** As math.radians. @param {number} degrees */
export const radians = (degrees) => degrees * (Math.PI / 180);
