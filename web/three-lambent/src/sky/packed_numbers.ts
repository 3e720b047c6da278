// Files of this package: eight letters, a header as JSON, arrays of whole numbers. As
// web/sky_data/packed_numbers.h writes them.

export class PackedNumbers<Header> {
  readonly header: Header;
  private readonly bytes: Uint8Array;
  private at: number;

  /** @throws Error if the bytes are something else */
  constructor(
    bytes: ArrayBuffer,
    magic: string,
    private readonly what: string,
  ) {
    const view = new DataView(bytes);
    const text = (from: number, length: number) =>
      new TextDecoder().decode(new Uint8Array(bytes, from, length));
    if (bytes.byteLength < 12 || text(0, 8) !== magic)
      throw new Error(`LambentSky: these bytes are not three-lambent's ${what}`);
    const length = view.getUint32(8, true);
    if (length > bytes.byteLength - 12) throw new Error(`LambentSky: ${what} is cut short`);
    this.header = JSON.parse(text(12, length)) as Header;
    this.at = 12 + length;
    this.bytes = new Uint8Array(bytes);
  }

  /** The next `count` numbers, times `scale`. @throws Error if there are not as many */
  take(count: number, scale: number): Float64Array {
    const out = new Float64Array(count);
    let sum = 0;
    for (let i = 0; i < count; ++i) {
      let [bits, factor, byte] = [0, 1, 128];
      for (; byte & 128; factor *= 128) {
        if (this.at >= this.bytes.length) throw new Error(`LambentSky: ${this.what} is cut short`);
        byte = this.bytes[this.at++];
        bits += (byte & 127) * factor;
      }
      sum += bits % 2 ? -(bits + 1) / 2 : bits / 2;
      out[i] = sum * scale;
    }
    return out;
  }
}
