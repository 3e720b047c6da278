// node tools/validate-gltf.mjs INPUTS FILE.glb…: Khronos' validator over each file; exits with 1 if
// one has an error. INPUTS is where tools/fetch-inputs.sh left the validator.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';

const [inputs, ...files] = process.argv.slice(2);
const validator = createRequire(join(resolve(inputs), 'package.json'))('gltf-validator');
let failed = false;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    ignoredIssues: ['UNSUPPORTED_EXTENSION', 'UNUSED_OBJECT'], // what a vendor extension points to
  });
  const { numErrors, numWarnings } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  for (const message of report.issues.messages)
    if (message.severity <= 1) console.log(`  ${message.code} ${message.pointer}: ${message.message}`);
  failed ||= numErrors > 0;
}
process.exit(failed ? 1 : 0);
