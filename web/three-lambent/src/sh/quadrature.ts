// Gauss-Legendre rules by Newton's iteration on P_n.

/** Nodes in (low, high) and their weights, exact for polynomials of degree 2·count − 1. */
export function gaussLegendre(
  count: number,
  low: number,
  high: number,
): { nodes: Float64Array; weights: Float64Array } {
  const nodes = new Float64Array(count);
  const weights = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    let t = Math.cos((Math.PI * (i + 0.75)) / (count + 0.5));
    let slope = 1;
    for (let step = 0; step < 100; ++step) {
      let before = 0;
      let p = 1;
      for (let l = 0; l < count; ++l) {
        const next = ((2 * l + 1) * t * p - l * before) / (l + 1);
        before = p;
        p = next;
      }
      slope = (count * (t * p - before)) / (t * t - 1);
      const move = p / slope;
      t -= move;
      if (Math.abs(move) < 1e-15) break;
    }
    nodes[count - 1 - i] = low + ((t + 1) / 2) * (high - low);
    weights[count - 1 - i] = (high - low) / ((1 - t * t) * slope * slope);
  }
  return { nodes, weights };
}
