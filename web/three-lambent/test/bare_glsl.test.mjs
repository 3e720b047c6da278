// What is taken out of shaders when they are embedded, and that nothing else is.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { it } from "node:test";
import { bareGlsl, tokensOf } from "../scripts/bare-glsl.mjs";

const kCases = [
  ["comments", "a = b; // c\n/* d\n   e */ f(); // \"x\" /* y\ng();", "a=b;f();g();\n"],
  ["a comment between two words", "int/* */a;", "int a;\n"],
  ["words", "in  vec2   place;\nreturn\n  x;", "in vec2 place;return x;\n"],
  ["numbers", "x = 1. + 2 - .5 * 1e-6 + 3u;", "x=1.+2-.5*1e-6+3u;\n"],
  ["signs that would be others", "a - -b; a + +b; a - --b; a < - b; !  =", "a- -b;a+ +b;a- --b;a<-b;! =\n"],
  ["a division and a comment's begin", "a / / b; a / *b; a * / b;", "a/ /b;a/ *b;a*/b;\n"],
  ["a member and a number", "v . x + 1 . x; v.x", "v.x+1 .x;v.x\n"],
  ["directives", "  #  if A && B\nx;\n#endif\n#include <common>\ny;", "#if A && B\nx;\n#endif\n#include <common>\ny;\n"],
  ["a macro, and one with an argument", "#define A (x)\n#define B(x)  -x", "#define A (x)\n#define B(x) -x\n"],
  ["a macro over lines", "#define A(i)   \\\n  f(i); \\\n  g(i)\nA(1) A(2)", "#define A(i) f(i); g(i)\nA(1)A(2)\n"],
  ["a directive under a comment", "// #if A\n/* #if B\n#if C */\n#if D // E", "#if D\n"],
  ["nothing", "  \n// a\n", ""],
];

for (const [what, text, bare] of kCases)
  it(`leaves of ${what} what a compiler reads`, () => {
    assert.equal(bareGlsl(text), bare);
    assert.equal(bareGlsl(bare), bare);
  });

/** Everything but white space, by a reader of its own: character after character. */
function inked(text) {
  let out = "";
  for (let i = 0; i < text.length; ++i) {
    if (text.startsWith("//", i)) while (i + 1 < text.length && text[i + 1] !== "\n") ++i;
    else if (text.startsWith("/*", i)) i = text.indexOf("*/", i + 2) + 1;
    else if (!/\s|\\/.test(text[i])) out += text[i];
  }
  return out;
}

it("loses no sign of the package's shaders, and joins none of their words", () => {
  const folders = ["../../../shaders/", "../src/glsl/"].map((path) => new URL(path, import.meta.url));
  const files = folders.flatMap((folder) =>
    readdirSync(folder)
      .filter((name) => name.endsWith(".glsl"))
      .map((name) => new URL(name, folder)),
  );
  assert.ok(files.length > 40, `${files.length} shaders`);
  for (const file of files) {
    const text = readFileSync(file, "utf8");
    const bare = bareGlsl(text);
    assert.equal(inked(bare), inked(text), file.pathname);
    const plain = text.replace(/\/\/.*|\/\*[\s\S]*?\*\//g, " ").replaceAll("\\\n", " ");
    assert.deepEqual(tokensOf(bare), tokensOf(plain), file.pathname);
    assert.doesNotMatch(bare, /\n\s|  |\S[^\n]*\S#/, file.pathname);
  }
});
