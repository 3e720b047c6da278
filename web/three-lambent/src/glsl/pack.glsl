// Numbers of results, coefficient after coefficient, each R, G, B, four in a texel, as the bits of
// floats. Before it: LAMBENT_ROWS, the coefficients; result(i), which is coefficient i.

uvec4 packedResults(int texel) {
  int first = 4 * texel;
  int row = first / 3;
  // Four numbers from the middle of a coefficient end within the next one.
  vec3 here = result(row);
  vec3 next = row + 1 < LAMBENT_ROWS ? result(row + 1) : vec3(0.0);
  int from = first - 3 * row;
  vec4 four = from == 0   ? vec4(here, next.x)
              : from == 1 ? vec4(here.yz, next.xy)
                          : vec4(here.z, next);
  return floatBitsToUint(four);
}
