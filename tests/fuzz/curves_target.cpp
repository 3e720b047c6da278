// Curves: CSV, or OBJ where the first byte is 'o' or 'v'.
#include "lambent/scene_io/curves.h"

#include "tests/fuzz/target.h"

namespace lambent::fuzz {

void curves(Bytes bytes) {
  const std::string_view text = textOf(bytes);
  const bool obj = !text.empty() && (text.front() == 'o' || text.front() == 'v');
  const auto format = obj ? scene_io::CurveFormat::Obj : scene_io::CurveFormat::Csv;
  const auto read = scene_io::parseCurves(text, format, "curves");
  if (!read) return require(read.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  require(!read->empty(), "there is a curve");
  for (const scene_io::Polyline& curve : *read) {
    require(curve.size() >= 2, "a curve has two points");
    for (const Vec3d& point : curve) require(point.allFinite(), "points are finite");
  }
}

}  // namespace lambent::fuzz
