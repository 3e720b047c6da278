// Pixels of a PNG of 8-bit RGB or RGBA, as the tool and the browser write them.
import { inflateSync } from "node:zlib";

/** { width, height, rgb }: three bytes a pixel, the top row first. Alpha is left out. */
export function decodePng(bytes) {
  const kSignature = "89504e470d0a1a0a";
  if (bytes.subarray(0, 8).toString("hex") !== kSignature) throw new Error("not a PNG");
  let [width, height, channels] = [0, 0, 0];
  const parts = [];
  for (let at = 8; at < bytes.length; ) {
    const length = bytes.readUInt32BE(at);
    const type = bytes.toString("latin1", at + 4, at + 8);
    const data = bytes.subarray(at + 8, at + 8 + length);
    if (type === "IHDR") {
      [width, height] = [data.readUInt32BE(0), data.readUInt32BE(4)];
      channels = { 2: 3, 6: 4 }[data[9]];
      if (data[8] !== 8 || channels === undefined || data[12] !== 0)
        throw new Error("a PNG of another kind than 8-bit RGB or RGBA");
    } else if (type === "IDAT") parts.push(data);
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = channels * width;
  const rows = new Uint8Array(stride * height);
  for (let y = 0, at = 0; y < height; ++y) {
    const filter = raw[at++];
    for (let i = 0; i < stride; ++i) {
      const here = y * stride + i;
      const left = i >= channels ? rows[here - channels] : 0;
      const up = y > 0 ? rows[here - stride] : 0;
      const corner = y > 0 && i >= channels ? rows[here - stride - channels] : 0;
      rows[here] = raw[at++] + predicted(filter, left, up, corner);
    }
  }
  const rgb = new Uint8Array(3 * width * height);
  for (let i = 0; i < width * height; ++i)
    rgb.set(rows.subarray(channels * i, channels * i + 3), 3 * i);
  return { width, height, rgb };
}

function predicted(filter, left, up, corner) {
  if (filter === 0) return 0;
  if (filter === 1) return left;
  if (filter === 2) return up;
  if (filter === 3) return (left + up) >> 1;
  const near = left + up - corner;
  const [a, b, c] = [left, up, corner].map((each) => Math.abs(near - each));
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/**
 * Mean absolute difference of the channels, in steps of 1/255, over pixels where `mask` (one byte
 * a pixel) is not 0, or over all. `place` maps a pixel of the first picture to one of the second.
 */
export function meanDifference(a, b, mask = null, place = (x, y) => [x, y]) {
  if (a.width !== b.width || a.height !== b.height)
    throw new Error(`${a.width}×${a.height} pixels against ${b.width}×${b.height}`);
  let [sum, count] = [0, 0];
  for (let y = 0; y < a.height; ++y)
    for (let x = 0; x < a.width; ++x) {
      const at = y * a.width + x;
      if (mask !== null && mask[at] === 0) continue;
      const [u, v] = place(x, y);
      const other = v * a.width + u;
      for (let c = 0; c < 3; ++c) sum += Math.abs(a.rgb[3 * at + c] - b.rgb[3 * other + c]);
      count += 3;
    }
  return sum / Math.max(1, count);
}
