// How what is shown would be baked, as people type it.
/** The line that bakes a file, for a shell. */
export function bakeLine(name: string): string {
  const quoted = (text: string) =>
    /^[\w.][\w.-]*$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
  return `lambent bake ${quoted(name)} -o ${quoted(name.replace(/(\.glb)?$/i, "-baked.glb"))}`;
}
