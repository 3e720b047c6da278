#include "apps/lambent/receiver_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "apps/lambent/arguments.h"
#include "lambent/file/atomic_file.h"

namespace lambent::tool {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the PLY is written as it lies in memory");

using Row = std::array<float, 9>;
constexpr std::string_view kColumns[9] = {"x", "y", "z", "nx", "ny", "nz", "r", "g", "b"};

Row rowOf(const ShadedReceiver& receiver) {
  const auto& [p, n, c] = receiver;
  return {p[0], p[1], p[2], n[0], n[1], n[2], c[0], c[1], c[2]};
}

ShadedReceiver receiverOf(const Row& row) {
  return {Vec3(row[0], row[1], row[2]), Vec3(row[3], row[4], row[5]), Rgb(row[6], row[7], row[8])};
}

std::string plyHeader(std::size_t count) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment exit radiance, linear RGB\n"
      "element vertex {}\n",
      count);
  for (const std::string_view column : kColumns)
    header += fmt::format("property float {}\n", column);
  return header + "end_header\n";
}

Error notOurs(const std::filesystem::path& path, std::string_view where) {
  return badInput(fmt::format(
      "{}: {}. Receivers are read as 'lambent shade' writes them: .ply or .csv with the columns "
      "x,y,z,nx,ny,nz,r,g,b",
      path.string(), where));
}

Result<std::vector<ShadedReceiver>> parsePly(std::string_view bytes,
                                             const std::filesystem::path& path) {
  constexpr std::string_view kElement = "element vertex ", kEnd = "end_header\n";
  const std::size_t element = bytes.find(kElement), end = bytes.find(kEnd);
  if (element == bytes.npos || end == bytes.npos || element > end)
    return notOurs(path, "no vertex element in the header");
  std::size_t count = 0;
  std::from_chars(bytes.data() + element + kElement.size(), bytes.data() + end, count);
  if (bytes.substr(0, end + kEnd.size()) != plyHeader(count))
    return notOurs(path, "the header names other columns");
  const std::string_view body = bytes.substr(end + kEnd.size());
  if (body.size() / sizeof(Row) != count || body.size() % sizeof(Row) != 0)
    return notOurs(path, fmt::format("the header promises {} rows of {} bytes, {} bytes follow",
                                     count, sizeof(Row), body.size()));
  std::vector<ShadedReceiver> receivers;
  receivers.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Row row;
    std::memcpy(row.data(), body.data() + i * sizeof(Row), sizeof(Row));
    receivers.push_back(receiverOf(row));
  }
  return receivers;
}

Result<std::vector<ShadedReceiver>> parseCsv(std::string_view text,
                                             const std::filesystem::path& path) {
  std::vector<ShadedReceiver> receivers;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (++line == 1) {
      if (row != fmt::format("{}", fmt::join(kColumns, ",")))
        return notOurs(path, "line 1 names other columns");
      continue;
    }
    Row values;
    const char* at = row.data();
    const char* const rowEnd = row.data() + row.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto [rest, error] = std::from_chars(at, rowEnd, values[i]);
      const bool last = i + 1 == values.size();
      if (error != std::errc() || (last ? rest != rowEnd : rest == rowEnd || *rest != ','))
        return notOurs(path, fmt::format("line {}, column {} is not a number", line, i + 1));
      at = last ? rest : rest + 1;
    }
    receivers.push_back(receiverOf(values));
  }
  return receivers;
}

}  // namespace

Status writeReceivers(const std::vector<ShadedReceiver>& receivers,
                      const std::filesystem::path& path) {
  std::string bytes;
  if (extensionOf(path) == ".csv") {
    bytes = fmt::format("{}\n", fmt::join(kColumns, ","));
    for (const ShadedReceiver& receiver : receivers)
      fmt::format_to(std::back_inserter(bytes), "{}\n", fmt::join(rowOf(receiver), ","));
  } else {
    bytes = plyHeader(receivers.size());
    bytes.reserve(bytes.size() + receivers.size() * sizeof(Row));
    for (const ShadedReceiver& receiver : receivers) {
      const Row row = rowOf(receiver);
      bytes.append(reinterpret_cast<const char*>(row.data()), sizeof(Row));
    }
  }
  return file::writeAtomically(path, bytes);
}

Result<std::vector<ShadedReceiver>> readReceivers(const std::filesystem::path& path) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return extensionOf(path) == ".csv" ? parseCsv(text, path) : parsePly(text, path);
}

}  // namespace lambent::tool
