// node tools/unpack-hdri.mjs FROM TO: modules `export default 'data:…;base64,…'` → plain .exr files.
import { mkdirSync, readFileSync, readdirSync, renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const [from, to] = process.argv.slice(2);
mkdirSync(to, { recursive: true });
for (const name of readdirSync(from).filter((each) => each.endsWith('.exr.js'))) {
  const module = readFileSync(join(from, name), 'latin1');
  const match = module.match(/base64,([A-Za-z0-9+/=]+)/);
  if (!match) throw new Error(`${join(from, name)}: no base64 data in it`);
  const path = join(to, name.slice(0, -'.js'.length));
  writeFileSync(`${path}.part`, Buffer.from(match[1], 'base64'));
  renameSync(`${path}.part`, path);
}
