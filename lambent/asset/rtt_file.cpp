// The file, in little-endian bytes (spec/rtt.md):
//
//   "LRTT"  u32 version  u32 length of the JSON   JSON, padded with spaces to a multiple of 4
//   float scales (snorm8 alone: one for each coefficient)   the numbers
//   since version 2: heights, a byte for each position and view, to the end of the file
#include "lambent/asset/rtt_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lambent/asset/json_fields.h"
#include "lambent/asset/rtt_part.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/budget.h"
#include "lambent/file/json.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

namespace {

using transfer::EncodedRtt;
using transfer::Encoding;

static_assert(std::endian::native == std::endian::little);

constexpr char kMagic[4] = {'L', 'R', 'T', 'T'};
constexpr std::uint32_t kWithoutHeights = 1, kWithHeights = 2;

struct Header {
  char magic[4];
  std::uint32_t version, jsonBytes;
};

template <class T>
void append(std::vector<std::byte>& bytes, const T& values) {
  const auto raw = std::as_bytes(std::span(values));
  const std::size_t before = bytes.size();
  bytes.resize(before + raw.size());
  std::copy(raw.begin(), raw.end(), bytes.begin() + std::ptrdiff_t(before));
}

template <class T>
std::span<const std::byte> take(std::span<const std::byte> bytes, std::vector<T>& values,
                                std::size_t count) {
  values.resize(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  return bytes.subspan(count * sizeof(T));
}

}  // namespace

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
                                 {"encoding", transfer::nameOf(rtt.values.encoding)}};
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  while (text.size() % 4 != 0) text += ' ';
  Header header{{},
                rtt.heights.empty() ? kWithoutHeights : kWithHeights,
                static_cast<std::uint32_t>(text.size())};
  std::memcpy(header.magic, kMagic, 4);

  std::vector<std::byte> bytes;
  bytes.reserve(sizeof header + text.size() + rtt.values.scales.size() * 4 +
                rtt.values.size() * transfer::bytesPerNumber(rtt.values.encoding) +
                rtt.heights.size());
  append(bytes, std::span(&header, 1));
  append(bytes, text);
  append(bytes, rtt.values.scales);
  append(bytes, rtt.values.byte);
  append(bytes, rtt.values.half);
  append(bytes, rtt.values.single);
  append(bytes, rtt.heights);
  return file::writeAtomically(path, std::span<const std::byte>(bytes));
}

Result<EncodedRtt> readRtt(const std::filesystem::path& path, const ReadOptions& options) {
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
  if (header.version != kWithoutHeights && header.version != kWithHeights)
    return bad("version " + std::to_string(header.version) +
               " of the format, where this Lambent "
               "reads " +
               std::to_string(kWithHeights) + ": make it anew with 'lambent rtt'");
  rest = rest.subspan(sizeof header);
  if (header.jsonBytes > rest.size())
    return bad("cut off: its header says " + std::to_string(header.jsonBytes) +
               " bytes of JSON, and " + std::to_string(rest.size()) + " are left");
  const auto* text = reinterpret_cast<const char*>(rest.data());
  const Result<nlohmann::json> parsed = file::parseJson({text, header.jsonBytes});
  rest = rest.subspan(header.jsonBytes);
  if (!parsed || !parsed->is_object()) return bad("its header is not a JSON object");
  const nlohmann::json& json = *parsed;

  Fault fault;
  JsonFields fields(json, "header", fault);
  EncodedRtt rtt = rttShapeFrom(fields, 1e9);
  const auto encoding = transfer::encodingNamed(fields.string("encoding"));
  if (!encoding) fields.complain("encoding", "is none of float16, float32 and snorm8");
  if (!fault.empty()) return bad(fault);

  rtt.values.encoding = *encoding;
  const std::size_t count = rtt.coefficientCount() * rtt.planeSize();
  const std::size_t scales = *encoding == Encoding::Snorm8 ? rtt.coefficientCount() : 0;
  const std::size_t heights =
      header.version == kWithHeights ? rtt.positionCount() * rtt.viewCount() : 0;
  const std::size_t needed =
      scales * sizeof(float) + count * transfer::bytesPerNumber(*encoding) + heights;
  if (rest.size() != needed)
    return bad((rest.size() < needed ? "cut off: " : "too long: ") + std::to_string(rest.size()) +
               " bytes of numbers where " + std::to_string(needed) + " are needed");
  file::Budget budget(options.memoryLimit);
  budget.addFile(file->size());
  if (Status fits = budget.hold(needed, path.string()); !fits) return fits.error();
  rest = take(rest, rtt.values.scales, scales);
  switch (*encoding) {
    case Encoding::Snorm8:
      rtt.values.block = rtt.planeSize();
      rest = take(rest, rtt.values.byte, count);
      break;
    case Encoding::Float16:
      rest = take(rest, rtt.values.half, count);
      break;
    case Encoding::Float32:
      rest = take(rest, rtt.values.single, count);
      break;
  }
  take(rest, rtt.heights, heights);
  if (const auto wrong = faultOf(rtt)) return bad(*wrong);
  return rtt;
}

bool isRtt(const std::filesystem::path& path) {
  char magic[4] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(magic, 4) && std::memcmp(magic, kMagic, 4) == 0;
}

}  // namespace lambent::asset
