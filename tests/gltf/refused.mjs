// node refused.mjs [--modules FOLDER]
//
// spec/refused.json against the JSON schema: what the table says that the schema refuses, and nothing
// else, is refused by it. The schema cannot see numbers, counts, nodes and what stands elsewhere.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseGlb } from '../../web/three-lambent/test/support/glb.mjs';
import { patched } from '../../web/three-lambent/test/support/patch.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const spec = join(here, '../../spec');
const NAME = 'LAMBENT_radiance_transfer';
const modules = process.argv[2] === '--modules' ? resolve(process.argv[3]) : here;
const Ajv = createRequire(join(modules, 'package.json'))('ajv/dist/2020').default;
const ajv = new Ajv();
const schemaOf = (what) =>
  ajv.compile(
    JSON.parse(readFileSync(join(spec, NAME, 'schema', `${what}.${NAME}.schema.json`)))
  );
const rootSchema = schemaOf('glTF');
const primitiveSchema = schemaOf('mesh.primitive');

/** Whether the schema takes the document's object, and those of the meshes that the scene shows. */
function fits({ extensions, scenes, scene = 0, nodes, meshes }) {
  if (extensions?.[NAME] !== undefined && !rootSchema(extensions[NAME])) return false;
  const shown = new Set((scenes?.[scene]?.nodes ?? []).map((node) => nodes[node]?.mesh));
  return meshes.every(
    (mesh, m) =>
      !shown.has(m) ||
      mesh.primitives.every((primitive) => {
        const object = primitive.extensions?.[NAME];
        return object === undefined || primitiveSchema(object);
      })
  );
}

const table = JSON.parse(readFileSync(join(spec, 'refused.json'), 'utf8'));
const problems = [];
let refusals = 0;
for (const { name, sample, patch, refused, schema = false } of table) {
  const { json } = patched(parseGlb(readFileSync(join(spec, 'samples', sample))), patch);
  const fit = fits(json);
  if (!fit) ++refusals;
  if (!refused && !fit) problems.push(`${name}: is legal, and the schema refuses it`);
  else if (schema === fit) problems.push(`${name}: the schema ${fit ? 'takes' : 'refuses'} it`);
}
console.log(`${table.length} files, ${refusals} refused by the schema, ${problems.length} problems`);
for (const problem of problems) console.log(`  ${problem}`);
process.exit(problems.length === 0 ? 0 : 1);
