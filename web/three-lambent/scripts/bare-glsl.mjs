// GLSL without what only people need: comments, and white space between tokens that stay apart
// without it. A page fetches every byte of it, and the compiler of shaders sees the same tokens.

// Names, numbers, signs (what would begin a comment is one); of two that begin alike the longer first.
const kToken =
  /[A-Za-z_]\w*|0[xX][0-9a-fA-F]+[uU]?|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:lf|LF|[uUfF])?|<<=|>>=|\+\+|--|<<|>>|&&|\|\||\^\^|##|\/[/*]|[-+*/%&|^=!<>]=|\S/g;

const withoutComments = (text) =>
  text.replace(/\/\/.*|\/\*[\s\S]*?\*\//g, (found) => (found.startsWith("//") ? "" : " "));

/** The tokens of a line or more that hold no comment and no directive. */
export const tokensOf = (text) => text.match(kToken) ?? [];

/** Whether two tokens that follow each other are no longer the same two when nothing is between. */
function wantsSpace(before, after) {
  const [first, ...rest] = tokensOf(before + after);
  return first !== before || rest.length !== 1;
}

const joined = (tokens) =>
  tokens.map((each, i) => (i > 0 && wantsSpace(tokens[i - 1], each) ? ` ${each}` : each)).join("");

/** A directive keeps a line of its own, and a space wherever it has some: in macros that can matter. */
const bareDirective = (line) => line.trim().replace(/\s+/g, " ").replace(/^# /, "#");

/**
 * The same shader, in fewer bytes. Directives, three's #include among them, stay lines of their own.
 *
 * @param {string} text GLSL, as preprocessors read it
 * @returns {string} ends with a line's end, so that texts can be put one after the other
 */
export function bareGlsl(text) {
  const lines = withoutComments(text.replace(/\\\r?\n/g, " ")).split("\n");
  let [out, tokens] = ["", []];
  const endCode = () => {
    if (tokens.length) out += `${joined(tokens)}\n`;
    tokens = [];
  };
  for (const line of lines)
    if (line.trim().startsWith("#")) {
      endCode();
      out += `${bareDirective(line)}\n`;
    } else tokens.push(...tokensOf(line));
  endCode();
  return out;
}
