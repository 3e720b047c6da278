// Numbers of results, coefficient after coefficient, each R, G, B, as halves: eight in a texel of
// integers. Before it: LAMBENT_ROWS, the coefficients; result(i), which is coefficient i, 0 beyond.

uvec4 packedResults(int texel) {
  int first = 8 * texel;
  int row = first / 3;
  float numbers[12];
  for (int k = 0; k < 4; ++k) {
    vec3 here = row + k < LAMBENT_ROWS ? clamp(result(row + k), -65504.0, 65504.0) : vec3(0.0);
    numbers[3 * k] = here.r;
    numbers[3 * k + 1] = here.g;
    numbers[3 * k + 2] = here.b;
  }
  int from = first - 3 * row;
  return uvec4(packHalf2x16(vec2(numbers[from], numbers[from + 1])),
               packHalf2x16(vec2(numbers[from + 2], numbers[from + 3])),
               packHalf2x16(vec2(numbers[from + 4], numbers[from + 5])),
               packHalf2x16(vec2(numbers[from + 6], numbers[from + 7])));
}
