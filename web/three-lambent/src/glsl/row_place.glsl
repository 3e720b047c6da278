// Where a row begins in an array texture: src/gpu/row-texture.ts. `rows`: rows a line, lines a
// layer, texels a row.

ivec3 rowPlace(ivec3 rows, int row) {
  int line = row / rows.x;
  int layer = line / rows.y;
  return ivec3((row - line * rows.x) * rows.z, line - layer * rows.y, layer);
}
