#include "lambent/asset/accessors.h"

#include <bit>
#include <string>

#include "lambent/scene_io/gltf_json.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

using nlohmann::json;
using transfer::Encoding;
using transfer::Numbers;

// glTF is little-endian, and numbers go there as they lie in memory.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Vec3) == 12);

AccessorReader::AccessorReader(const scene_io::GltfFile& file) : file_(file) {
  if (const json* buffers = scene_io::find(file.json(), "buffers"); buffers && buffers->is_array())
    for (const json& buffer : *buffers)
      if (const json* length = scene_io::find(buffer, "byteLength"); length && length->is_number())
        budget_ += length->get<double>();
}

std::optional<scene_io::AccessorView> AccessorReader::open(JsonFields& fields, std::string_view key,
                                                           Component component, int componentCount,
                                                           std::size_t bytesEach) {
  const std::int64_t index = fields.integer(key, 0, std::numeric_limits<std::int32_t>::max());
  if (!read_.insert(index).second) {
    fields.complain(key, "accessor " + std::to_string(index) + " serves two members");
    return std::nullopt;
  }
  const Result<scene_io::AccessorView> view = file_.accessorView(index);
  if (!view) {
    // The message names the file; so will the one that this becomes a part of.
    std::string message = view.error().message;
    if (const std::string path = file_.path().string() + ": "; message.starts_with(path))
      message.erase(0, path.size());
    fields.complain(key, message);
    return std::nullopt;
  }
  if (view->component != component || view->componentCount != componentCount) {
    fields.complain(key, "accessor " + std::to_string(index) + " has component type " +
                             std::to_string(int(view->component)) + " × " +
                             std::to_string(view->componentCount) + " where " +
                             std::to_string(int(component)) + " × " +
                             std::to_string(componentCount) + " is needed");
    return std::nullopt;
  }
  budget_ -= double(view->count) * double(bytesEach);
  if (budget_ < 0) {
    fields.complain(key, "accessors overlap: together they are larger than the file's buffers");
    return std::nullopt;
  }
  if (Status fits =
          file_.budget().hold(view->count * bytesEach, "accessor " + std::to_string(index));
      !fits) {
    fields.complain(key, fits.error().message);
    return std::nullopt;
  }
  return *view;
}

json toJson(const Numbers& numbers, scene_io::GltfBuilder& gltf, json members) {
  members["encoding"] = transfer::nameOf(numbers.encoding);
  const auto add = [&](const auto& values, Component component) {
    return gltf.addAccessor(bytesOf(values), component, "SCALAR", values.size());
  };
  switch (numbers.encoding) {
    case Encoding::Float16:
      members["accessor"] = add(numbers.half, Component::UnsignedShort);
      break;
    case Encoding::Float32:
      members["accessor"] = add(numbers.single, Component::Float);
      break;
    case Encoding::Snorm8:
      members["accessor"] = add(numbers.byte, Component::Byte);
      members["scales"] = add(numbers.scales, Component::Float);
      break;
  }
  return members;
}

Numbers numbersFrom(JsonFields& fields, AccessorReader& accessors, Snorm8 snorm8) {
  Numbers numbers;
  const auto encoding = transfer::encodingNamed(fields.string("encoding"));
  if (!encoding || (encoding == Encoding::Snorm8 && snorm8 == Snorm8::Refused))
    fields.complain("encoding", snorm8 == Snorm8::Allowed ? "is none of float16, float32 and snorm8"
                                                          : "is neither float16 nor float32");
  numbers.encoding = encoding.value_or(Encoding::Float32);
  if (numbers.encoding != Encoding::Snorm8 && fields.has("scales"))
    fields.complain("scales", "are for snorm8 alone");
  switch (numbers.encoding) {
    case Encoding::Float16:
      numbers.half = accessors.read<std::uint16_t>(fields, "accessor", Component::UnsignedShort, 1);
      break;
    case Encoding::Float32:
      numbers.single = accessors.read<float>(fields, "accessor", Component::Float, 1);
      break;
    case Encoding::Snorm8:
      numbers.byte = accessors.read<std::int8_t>(fields, "accessor", Component::Byte, 1);
      numbers.scales = accessors.read<float>(fields, "scales", Component::Float, 1);
      if (numbers.scales.empty() || numbers.byte.size() % numbers.scales.size() != 0)
        fields.complain("scales", "do not divide the numbers into equal runs");
      else
        numbers.block = numbers.byte.size() / numbers.scales.size();
      break;
  }
  if (numbers.empty()) fields.complain("accessor", "is empty");
  return numbers;
}

int channelsFrom(JsonFields& fields) {
  const auto channels = int(fields.integer("channels", 1, 3));
  if (channels == 2) fields.complain("channels", "is 2, not 1 or 3");
  return channels;
}

Vec2 pairFrom(JsonFields& fields, std::string_view key) {
  const std::vector<double> pair = fields.numbers(key, 2);
  if (pair.size() == 2) return Vec2(float(pair[0]), float(pair[1]));
  fields.complain(key, "is not an array of 2 numbers");
  return Vec2(1.0f, 1.0f);
}

}  // namespace lambent::asset
