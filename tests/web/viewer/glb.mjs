// A .glb with other members in its JSON.

/** `part` is assigned over the file's JSON. */
export function withJson(glb, part) {
  const length = glb.readUInt32LE(12);
  const json = { ...JSON.parse(glb.toString("utf8", 20, 20 + length)), ...part };
  let text = JSON.stringify(json);
  while (Buffer.byteLength(text) % 4 !== 0) text += " ";
  const chunk = Buffer.from(text);
  const rest = glb.subarray(20 + length);
  const head = Buffer.alloc(20);
  glb.copy(head, 0, 0, 20);
  head.writeUInt32LE(20 + chunk.length + rest.length, 8);
  head.writeUInt32LE(chunk.length, 12);
  return Buffer.concat([head, chunk, rest]);
}
