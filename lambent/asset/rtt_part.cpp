#include "lambent/asset/rtt_part.h"

#include <cmath>

#include "lambent/asset/format.h"

namespace lambent::asset {

using nlohmann::json;
using transfer::EncodedRtt;

json toJson(const EncodedRtt& rtt, scene_io::GltfBuilder& gltf) {
  json object = {{"name", rtt.name},     {"width", rtt.width},
                 {"height", rtt.height}, {"views", rtt.views},
                 {"bands", rtt.bands},   {"size", {rtt.size.x(), rtt.size.y()}},
                 {"depth", rtt.depth},   {"values", toJson(rtt.values, gltf)}};
  if (!rtt.heights.empty())
    object["heights"] = gltf.addAccessor(bytesOf(rtt.heights), Component::UnsignedByte, "SCALAR",
                                         rtt.heights.size());
  return object;
}

EncodedRtt rttShapeFrom(JsonFields& object, double deepest) {
  EncodedRtt rtt;
  if (object.has("name")) rtt.name = object.string("name");
  rtt.width = int(object.integer("width", 1, kLargestRtt));
  rtt.height = int(object.integer("height", 1, kLargestRtt));
  rtt.views = int(object.integer("views", 1, kLargestViews));
  rtt.bands = int(object.integer("bands", 1, sh::kMaxBands));
  rtt.size = pairFrom(object, "size");
  rtt.depth = float(object.number("depth", 0.0, deepest));
  return rtt;
}

EncodedRtt rttFrom(JsonFields object, AccessorReader& accessors) {
  EncodedRtt rtt = rttShapeFrom(object, std::numeric_limits<float>::max());
  JsonFields values = object.object("values");
  rtt.values = numbersFrom(values, accessors, Snorm8::Allowed);
  if (object.has("heights")) {
    rtt.heights = accessors.read<std::uint8_t>(object, "heights", Component::UnsignedByte, 1);
    if (rtt.heights.empty()) object.complain("heights", "is empty");
  }
  return rtt;
}

namespace {

Wrong faultOfShape(const EncodedRtt& rtt) {
  const auto within = [](int value, int most) { return value >= 1 && value <= most; };
  if (!within(rtt.width, kLargestRtt) || !within(rtt.height, kLargestRtt))
    return std::to_string(rtt.width) + "×" + std::to_string(rtt.height) + " positions, not 1 to " +
           std::to_string(kLargestRtt) + " each way";
  if (!within(rtt.views, kLargestViews))
    return std::to_string(rtt.views) + " views a side, not 1 to " + std::to_string(kLargestViews);
  if (!bandsInRange(rtt.bands))
    return "bands is " + std::to_string(rtt.bands) + ", not 1 to " + std::to_string(sh::kMaxBands);
  if (!rtt.size.allFinite() || !(rtt.size.minCoeff() > 0.0f))
    return std::string("the patch's size is not two finite numbers above 0");
  if (!std::isfinite(rtt.depth) || rtt.depth < 0.0f)
    return std::string("the patch's depth is not a finite number of 0 or more");
  return std::nullopt;
}

}  // namespace

Wrong faultOf(const EncodedRtt& rtt) {
  if (auto wrong = faultOfShape(rtt)) return wrong;
  const std::size_t needed = rtt.coefficientCount() * rtt.planeSize();
  if (rtt.values.size() != needed)
    return std::to_string(rtt.values.size()) + " numbers where " + std::to_string(needed) +
           " are needed";
  if (rtt.values.encoding == transfer::Encoding::Snorm8 &&
      (rtt.values.block != rtt.planeSize() || rtt.values.scales.size() != rtt.coefficientCount()))
    return std::string("snorm8 needs one scale for each coefficient");
  if (!rtt.heights.empty() && rtt.heights.size() != rtt.positionCount() * rtt.viewCount())
    return std::to_string(rtt.heights.size()) + " heights where " +
           std::to_string(rtt.positionCount() * rtt.viewCount()) + " are needed";
  if (const auto at = firstNonFinite(rtt.values))
    return "not a finite number at coefficient " + std::to_string(*at / rtt.planeSize()) +
           ", place " + std::to_string(*at % rtt.planeSize());
  return std::nullopt;
}

void count(const EncodedRtt& rtt, PartBytes& bytes) {
  bytes.rtts += transfer::bytesOf(rtt.values) + rtt.heights.size();
}

}  // namespace lambent::asset
