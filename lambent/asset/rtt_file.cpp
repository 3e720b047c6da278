// The file, in little-endian bytes (spec/rtt.md):
//
//   "LRTT"  u32 version  u32 length of the JSON   JSON, padded with spaces to a multiple of 4
//   float scales (snorm8 alone: one for each coefficient)   the numbers to the end of the file
#include "lambent/asset/rtt_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lambent/asset/check.h"
#include "lambent/asset/json_fields.h"
#include "lambent/asset/names.h"
#include "lambent/file/atomic_file.h"
#include "lambent/sh/coefficients.h"

namespace lambent::asset {

namespace {

using encode::EncodedRtt;
using encode::Encoding;
using encode::Numbers;

static_assert(std::endian::native == std::endian::little);

constexpr char kMagic[4] = {'L', 'R', 'T', 'T'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  char magic[4];
  std::uint32_t version, jsonBytes;
};

std::size_t coefficientsOf(const EncodedRtt& rtt) {
  return std::size_t(rtt.bands) * std::size_t(rtt.bands);
}
std::size_t planeSizeOf(const EncodedRtt& rtt) {
  return std::size_t(rtt.width) * rtt.height * rtt.views * rtt.views * 3;
}
std::size_t bytesPerNumber(Encoding encoding) {
  return encoding == Encoding::Snorm8 ? 1 : encoding == Encoding::Float16 ? 2 : 4;
}

template <class T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& values) {
  const auto raw = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <class T>
std::span<const std::byte> take(std::span<const std::byte> bytes, std::vector<T>& values,
                                std::size_t count) {
  values.resize(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  return bytes.subspan(count * sizeof(T));
}

std::optional<std::string> faultOfShape(const EncodedRtt& rtt) {
  const auto within = [](int value, int most) { return value >= 1 && value <= most; };
  if (!within(rtt.width, kLargestRtt) || !within(rtt.height, kLargestRtt))
    return std::to_string(rtt.width) + "×" + std::to_string(rtt.height) + " positions, not 1 to " +
           std::to_string(kLargestRtt) + " each way";
  if (!within(rtt.views, kLargestViews))
    return std::to_string(rtt.views) + " views a side, not 1 to " + std::to_string(kLargestViews);
  if (!within(rtt.bands, sh::kMaxBands))
    return "bands is " + std::to_string(rtt.bands) + ", not 1 to " + std::to_string(sh::kMaxBands);
  if (!rtt.size.allFinite() || !(rtt.size.minCoeff() > 0.0f))
    return std::string("the patch's size is not two finite numbers above 0");
  if (!std::isfinite(rtt.depth) || rtt.depth < 0.0f)
    return std::string("the patch's depth is not a finite number of 0 or more");
  return std::nullopt;
}

}  // namespace

std::optional<std::string> faultOf(const EncodedRtt& rtt) {
  if (auto fault = faultOfShape(rtt)) return fault;
  const std::size_t needed = coefficientsOf(rtt) * planeSizeOf(rtt);
  if (rtt.values.size() != needed)
    return std::to_string(rtt.values.size()) + " numbers where " + std::to_string(needed) +
           " are needed";
  if (rtt.values.encoding == Encoding::Snorm8 &&
      (rtt.values.block != planeSizeOf(rtt) || rtt.values.scales.size() != coefficientsOf(rtt)))
    return std::string("snorm8 needs one scale for each coefficient");
  if (const auto at = firstNonFinite(rtt.values))
    return "not a finite number at coefficient " + std::to_string(*at / planeSizeOf(rtt)) +
           ", place " + std::to_string(*at % planeSizeOf(rtt));
  return std::nullopt;
}

Status writeRtt(const EncodedRtt& rtt, const std::filesystem::path& path) {
  if (path.extension() != ".rtt")
    return report::badUsage(path.string() +
                            ": a radiance transfer texture: give its name the extension .rtt");
  if (const auto fault = faultOf(rtt))
    return report::failed(path.string() + ": not written: " + *fault);
  nlohmann::ordered_json json = {{"generator", "Lambent"},
                                 {"name", rtt.name},
                                 {"width", rtt.width},
                                 {"height", rtt.height},
                                 {"views", rtt.views},
                                 {"bands", rtt.bands},
                                 {"size", {rtt.size.x(), rtt.size.y()}},
                                 {"depth", rtt.depth},
                                 {"encoding", nameOf(rtt.values.encoding)}};
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  while (text.size() % 4 != 0) text += ' ';
  Header header{{}, kVersion, static_cast<std::uint32_t>(text.size())};
  std::memcpy(header.magic, kMagic, 4);

  std::vector<std::byte> bytes;
  bytes.reserve(sizeof header + text.size() + rtt.values.scales.size() * 4 +
                rtt.values.size() * bytesPerNumber(rtt.values.encoding));
  const auto raw = std::as_bytes(std::span(&header, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
  const auto words = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), words.begin(), words.end());
  append(bytes, rtt.values.scales);
  append(bytes, rtt.values.byte);
  append(bytes, rtt.values.half);
  append(bytes, rtt.values.single);
  return file::writeAtomically(path, std::span<const std::byte>(bytes));
}

Result<EncodedRtt> readRtt(const std::filesystem::path& path) {
  const auto bad = [&](const std::string& what) {
    return report::badInput(path.string() + ": " + what);
  };
  const Result<std::vector<std::byte>> file = file::readWhole(path);
  if (!file) return file.error();
  std::span<const std::byte> rest(*file);
  Header header{};
  if (rest.size() >= sizeof header) std::memcpy(&header, rest.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, 4) != 0)
    return bad(
        "not a radiance transfer texture: it does not begin with \"LRTT\". Make one with "
        "'lambent rtt'");
  if (header.version != kVersion)
    return bad("version " + std::to_string(header.version) +
               " of the format, where this Lambent "
               "reads " +
               std::to_string(kVersion) + ": make it anew with 'lambent rtt'");
  rest = rest.subspan(sizeof header);
  if (header.jsonBytes > rest.size())
    return bad("cut off: its header says " + std::to_string(header.jsonBytes) +
               " bytes of JSON, and " + std::to_string(rest.size()) + " are left");
  const auto* text = reinterpret_cast<const char*>(rest.data());
  const nlohmann::json json = nlohmann::json::parse(text, text + header.jsonBytes, nullptr, false);
  rest = rest.subspan(header.jsonBytes);
  if (json.is_discarded() || !json.is_object()) return bad("its header is not a JSON object");

  Fault fault;
  JsonFields fields(json, "header", fault);
  EncodedRtt rtt;
  if (fields.has("name")) rtt.name = fields.string("name");
  rtt.width = int(fields.integer("width", 1, kLargestRtt));
  rtt.height = int(fields.integer("height", 1, kLargestRtt));
  rtt.views = int(fields.integer("views", 1, kLargestViews));
  rtt.bands = int(fields.integer("bands", 1, sh::kMaxBands));
  rtt.depth = float(fields.number("depth", 0.0, 1e9));
  const std::vector<double> size = fields.numbers("size", 2);
  if (size.size() == 2)
    rtt.size = Vec2(float(size[0]), float(size[1]));
  else
    fields.complain("size", "is not two numbers");
  const auto encoding = encodingNamed(fields.string("encoding"));
  if (!encoding) fields.complain("encoding", "is none of float16, float32 and snorm8");
  if (!fault.empty()) return bad(fault);
  if (const auto wrong = faultOfShape(rtt)) return bad(*wrong);

  rtt.values.encoding = *encoding;
  const std::size_t count = coefficientsOf(rtt) * planeSizeOf(rtt);
  const std::size_t scales = *encoding == Encoding::Snorm8 ? coefficientsOf(rtt) : 0;
  const std::size_t needed = scales * sizeof(float) + count * bytesPerNumber(*encoding);
  if (rest.size() != needed)
    return bad((rest.size() < needed ? "cut off: " : "too long: ") + std::to_string(rest.size()) +
               " bytes of numbers where " + std::to_string(needed) + " are needed");
  rest = take(rest, rtt.values.scales, scales);
  switch (*encoding) {
    case Encoding::Snorm8:
      rtt.values.block = planeSizeOf(rtt);
      take(rest, rtt.values.byte, count);
      break;
    case Encoding::Float16:
      take(rest, rtt.values.half, count);
      break;
    case Encoding::Float32:
      take(rest, rtt.values.single, count);
      break;
  }
  if (const auto wrong = faultOf(rtt)) return bad(*wrong);
  return rtt;
}

bool isRtt(const std::filesystem::path& path) {
  char magic[4] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(magic, 4) && std::memcmp(magic, kMagic, 4) == 0;
}

}  // namespace lambent::asset
