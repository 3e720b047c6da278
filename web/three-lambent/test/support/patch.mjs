// Patches of spec/refused.json: JSON Patch (RFC 6902; add, remove, replace and copy) on the document,
// "poke" and "cut" on its bytes.

const kWriters = {
  5120: [1, "writeInt8"],
  5121: [1, "writeUInt8"],
  5123: [2, "writeUInt16LE"],
  5126: [4, "writeFloatLE"],
};
const kOdd = { nan: NaN, inf: Infinity, "-inf": -Infinity };

/** The parent of what a JSON pointer names, and the last of its keys. */
function resolve(json, pointer) {
  const keys = pointer
    .split("/")
    .slice(1)
    .map((key) => key.replaceAll("~1", "/").replaceAll("~0", "~"));
  const last = keys.pop();
  const parent = keys.reduce((at, key) => at?.[key], json);
  if (typeof parent !== "object" || parent === null) throw new Error(`${pointer}: has no parent`);
  return { parent, key: last };
}

function valueAt(json, pointer) {
  const { parent, key } = resolve(json, pointer);
  if (!Object.hasOwn(parent, key)) throw new Error(`${pointer}: does not exist`);
  return parent[key];
}

function addAt(json, pointer, value) {
  const { parent, key } = resolve(json, pointer);
  if (!Array.isArray(parent)) parent[key] = value;
  else if (key === "-") parent.push(value);
  else parent.splice(Number(key), 0, value);
}

function removeAt(json, pointer) {
  valueAt(json, pointer);
  const { parent, key } = resolve(json, pointer);
  if (Array.isArray(parent)) parent.splice(Number(key), 1);
  else delete parent[key];
}

/** One number of an accessor, as its component type stores it. */
function poke(json, bin, { accessor, number, value }) {
  const { bufferView, byteOffset = 0, componentType } = json.accessors[accessor];
  const [size, write] = kWriters[componentType];
  const at = (json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset + number * size;
  bin[write](typeof value === "string" ? kOdd[value] : value, at);
}

/** A copy of { json, bin } with the patch applied. */
export function patched({ json, bin }, patch) {
  const document = structuredClone(json);
  let bytes = Buffer.from(bin);
  for (const step of patch) {
    const { op, path, from, value } = structuredClone(step);
    if (op === "add") addAt(document, path, value);
    else if (op === "remove") removeAt(document, path);
    else if (op === "replace") {
      removeAt(document, path);
      addAt(document, path, value);
    } else if (op === "copy") addAt(document, path, structuredClone(valueAt(document, from)));
    else if (op === "poke") poke(document, bytes, step);
    else if (op === "cut") bytes = bytes.subarray(0, step.bytes);
    else throw new Error(`${op}: is no operation of a patch`);
  }
  return { json: document, bin: bytes };
}
