// Which receiver and which of its texels this is. Before it: begin(), result() and pack.glsl.

uniform int receivers;
uniform int receiversALine;

out uvec4 lit;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int column = at.x / LAMBENT_TEXELS;
  int receiver = at.y * receiversALine + column;
  lit = uvec4(0u);
  if (receiver >= receivers) return;
  begin(receiver);
  lit = packedResults(at.x - column * LAMBENT_TEXELS);
}
