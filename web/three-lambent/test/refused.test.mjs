// spec/refused.json: samples with a change each, and whether a reader takes them. The C++ reader's
// test goes through the same table.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { readTransfer } from "../dist/format/read.js";
import { LambentLoaderPlugin } from "../dist/loader-plugin.js";
import { glb, parseGlb } from "./support/glb.mjs";
import { patched } from "./support/patch.mjs";

const spec = new URL("../../../spec/", import.meta.url);
const table = JSON.parse(readFileSync(new URL("refused.json", spec), "utf8"));

function read({ json, bin }) {
  const bytes = bin.buffer.slice(bin.byteOffset, bin.byteOffset + bin.byteLength);
  return readTransfer({ json, buffer: async () => bytes });
}

describe("refused or not, as the table says", () => {
  for (const { name, sample, patch, refused, place } of table)
    it(name, async () => {
      const file = patched(parseGlb(readFileSync(new URL(`samples/${sample}`, spec))), patch);
      if (!refused) {
        await read(file);
        return;
      }
      await assert.rejects(read(file), (error) => {
        assert.equal(error.name, "LambentFormatError", error.stack);
        // "PLACE: WHAT", where the place may go on to a member: ".bands", "[2]".
        if (place !== undefined) {
          assert.equal(error.message.slice(0, place.length), place, error.message);
          assert.match(error.message[place.length], /[:.[]/, error.message);
        }
        return true;
      });
    });
});

describe("by three's own loader", () => {
  const load = ({ json, bin }) => {
    const bytes = glb(json, bin);
    const loader = new GLTFLoader().register((parser) => new LambentLoaderPlugin(parser));
    return loader.parseAsync(
      bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length),
      "",
    );
  };
  const named = (name) => {
    const { sample, patch, place } = table.find((entry) => entry.name === name);
    const file = patched(parseGlb(readFileSync(new URL(`samples/${sample}`, spec))), patch);
    return { file, place };
  };

  for (const name of [
    "no scenes",
    "a scene that does not exist",
    "a node that is its own child",
    "no POSITION",
    "POSITION of an accessor that does not exist",
    "NORMAL that is not finite",
    "a mirror whose NORMAL is not finite",
  ])
    it(name, async () => {
      const { file, place } = named(name);
      await assert.rejects(load(file), (error) => {
        assert.equal(error.name, "LambentFormatError", error.stack);
        assert.equal(error.message.slice(0, place.length + 1), `${place}:`);
        return true;
      });
    });

  for (const name of ["every-layout.glb as it is", "a mirror without POSITION", "no scene chosen"])
    it(name, async () => {
      const { userData } = await load(named(name).file);
      assert.ok(userData.lambent);
      userData.lambent.dispose();
    });
});
