// node validate.mjs [--modules FOLDER] FILE.glb…
//
// Looks at each file with tools that are not ours, and exits with 1 if one of them objects:
//  1. Khronos' validator: no error, no warning;
//  2. JSON schema (ajv): the extension's objects against spec/LAMBENT_radiance_transfer/schema;
//  3. glTF-Transform: reads the file, and finds every accessor of the extension with the size that
//     the extension's own text demands.
// The tools are the dependencies of the package.json beside this file (`npm ci`), or those under
// FOLDER/node_modules.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const NAME = 'LAMBENT_radiance_transfer';
const BYTES = { 5120: 1, 5121: 1, 5123: 2, 5126: 4 };

const args = process.argv.slice(2);
let modules = here;
if (args[0] === '--modules') modules = resolve(args.splice(0, 2)[1]);
if (args.length === 0) {
  console.error('usage: node validate.mjs [--modules FOLDER] FILE.glb…');
  process.exit(2);
}

const require = createRequire(join(modules, 'package.json'));
const validator = require('gltf-validator');
const Ajv = require('ajv/dist/2020').default;
const { NodeIO, Logger } = await import(pathToFileURL(require.resolve('@gltf-transform/core')));

const ajv = new Ajv({ allErrors: true });
const schemaOf = (what) =>
  ajv.compile(
    JSON.parse(readFileSync(join(here, '../../spec', NAME, 'schema', `${what}.${NAME}.schema.json`)))
  );
const rootSchema = schemaOf('glTF');
const primitiveSchema = schemaOf('mesh.primitive');

function jsonOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(0, true) !== 0x46546c67) throw new Error('is not a .glb');
  return JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + view.getUint32(12, true))));
}

async function khronos(file, bytes, complain) {
  const report = await validator.validateBytes(bytes, {
    uri: file,
    maxIssues: 0,
    // A vendor extension is unknown to the validator, and so is the use of what it points to.
    ignoredIssues: ['UNSUPPORTED_EXTENSION', 'UNUSED_OBJECT'],
  });
  for (const { severity, code, pointer, message } of report.issues.messages)
    if (severity <= 1) complain(`validator: ${code} ${pointer}: ${message}`);
}

/** Every primitive that carries the extension, with its place. */
function* primitivesOf(document) {
  for (const [m, mesh] of (document.meshes ?? []).entries())
    for (const [p, primitive] of mesh.primitives.entries()) {
      const object = primitive.extensions?.[NAME];
      if (object) yield { primitive, object, place: `/meshes/${m}/primitives/${p}/extensions/${NAME}` };
    }
}

function schemas(document, complain) {
  const check = (schema, object, place) => {
    if (schema(object)) return;
    for (const { instancePath, message } of schema.errors)
      complain(`schema: ${place}${instancePath}: ${message}`);
  };
  const root = document.extensions?.[NAME];
  if (!root) return complain(`schema: /extensions/${NAME}: is missing`);
  check(rootSchema, root, `/extensions/${NAME}`);
  for (const { object, place } of primitivesOf(document)) check(primitiveSchema, object, place);
}

async function elsewhere(document, bytes, complain) {
  const io = new NodeIO().setLogger(new Logger(Logger.Verbosity.ERROR));
  const root = (await io.readBinary(bytes)).getRoot();
  const accessors = root.listAccessors();
  if (root.listMeshes().length !== document.meshes.length)
    complain(`glTF-Transform: ${root.listMeshes().length} meshes of ${document.meshes.length}`);
  const expect = (place, index, componentType, type, count) => {
    const accessor = accessors[index];
    const found = accessor && [accessor.getComponentType(), accessor.getType(), accessor.getCount()];
    if (String(found) !== String([componentType, type, count]))
      complain(`glTF-Transform: ${place}: accessor ${index} is ${found}, not ${[componentType, type, count]}`);
    else if (accessor.getArray().BYTES_PER_ELEMENT !== BYTES[componentType])
      complain(`glTF-Transform: ${place}: accessor ${index} came in another type`);
  };
  const component = { float16: 5123, float32: 5126, snorm8: 5120 };
  const expectNumbers = (place, numbers, count, scales) => {
    expect(place, numbers.accessor, component[numbers.encoding], 'SCALAR', count);
    if (numbers.encoding === 'snorm8') expect(`${place}/scales`, numbers.scales, 5126, 'SCALAR', scales);
  };
  const rtts = document.extensions[NAME].rtts ?? [];
  for (const [i, rtt] of rtts.entries())
    expectNumbers(`/extensions/${NAME}/rtts/${i}`, rtt.values,
      rtt.bands ** 2 * rtt.width * rtt.height * rtt.views ** 2 * 3, rtt.bands ** 2);
  for (const { primitive, object, place } of primitivesOf(document)) {
    const { grid, vectors, matrices, shadowed: kept, biScale } = object;
    const receivers = grid
      ? grid.width * grid.height
      : document.accessors[primitive.attributes.POSITION].count;
    if (vectors)
      expect(`${place}/vectors`, vectors.accessor, component[vectors.encoding], 'SCALAR',
        receivers * vectors.channels * vectors.bands ** 2);
    if (matrices)
      expect(`${place}/matrices`, matrices.accessor, component[matrices.encoding], 'SCALAR',
        receivers * matrices.channels * matrices.outBands ** 2 * matrices.inBands ** 2);
    if (kept?.vectors)
      expectNumbers(`${place}/shadowed/vectors`, kept.vectors,
        receivers * kept.vectors.channels * vectors.bands ** 2);
    if (kept?.matrices)
      expectNumbers(`${place}/shadowed/matrices`, kept.matrices,
        receivers * kept.matrices.channels * matrices.outBands ** 2 * matrices.inBands ** 2);
    if (biScale) {
      if (!rtts[biScale.rtt]) complain(`${place}/biScale: there is no rtt ${biScale.rtt}`);
      expect(`${place}/biScale/tangents`, biScale.tangents, 5126, 'VEC3', receivers);
      const { idMap, shadowed, interreflected } = biScale;
      if (idMap)
        expect(`${place}/biScale/idMap`, idMap.accessor, 5123, 'SCALAR', 2 * idMap.width * idMap.height);
      const matrix = biScale.bands ** 4;
      if (shadowed)
        expectNumbers(`${place}/biScale/shadowed`, shadowed, receivers * matrix, receivers);
      if (interreflected)
        expectNumbers(`${place}/biScale/interreflected`, interreflected,
          receivers * interreflected.channels * matrix, receivers * interreflected.channels);
    }
    if (grid) {
      expect(`${place}/grid/positions`, grid.positions, 5126, 'VEC3', receivers);
      expect(`${place}/grid/normals`, grid.normals, 5126, 'VEC3', receivers);
      expect(`${place}/grid/covered`, grid.covered, 5121, 'SCALAR', receivers);
    }
  }
}

let failed = false;
for (const file of args) {
  const problems = [];
  const complain = (problem) => problems.push(problem);
  try {
    const bytes = new Uint8Array(readFileSync(file));
    await khronos(file, bytes, complain);
    const document = jsonOf(bytes);
    schemas(document, complain);
    await elsewhere(document, bytes, complain);
  } catch (error) {
    complain(String(error));
  }
  console.log(`${file}: ${problems.length === 0 ? 'good' : `${problems.length} problems`}`);
  for (const problem of problems.slice(0, 20)) console.log(`  ${problem}`);
  failed ||= problems.length > 0;
}
process.exit(failed ? 1 : 0);
