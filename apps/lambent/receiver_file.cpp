#include "apps/lambent/receiver_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "apps/lambent/arguments.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/budget.h"

namespace lambent::tool {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the PLY is written as it lies in memory");

constexpr std::size_t kMostColumns = 12, kColumnsWithoutVariance = 9;
using Row = std::array<float, kMostColumns>;
constexpr std::string_view kNames[kMostColumns] = {"x", "y", "z", "nx", "ny", "nz",
                                                   "r", "g", "b", "vr", "vg", "vb"};
using Columns = std::span<const std::string_view>;

Columns columnsOf(bool variance) {
  return Columns(kNames).first(variance ? kMostColumns : kColumnsWithoutVariance);
}

Row rowOf(const ReceiverFile& file, std::size_t i) {
  const auto& [p, n, c] = file.receivers[i];
  const Rgb v = file.variances.empty() ? Rgb(Rgb::Zero()) : file.variances[i];
  return {p[0], p[1], p[2], n[0], n[1], n[2], c[0], c[1], c[2], v[0], v[1], v[2]};
}

void add(ReceiverFile& file, const Row& row, bool variance) {
  file.receivers.push_back(
      {Vec3(row[0], row[1], row[2]), Vec3(row[3], row[4], row[5]), Rgb(row[6], row[7], row[8])});
  if (variance) file.variances.push_back(Rgb(row[9], row[10], row[11]));
}

std::string plyHeader(std::size_t count, Columns columns) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment exit radiance, linear RGB\n"
      "element vertex {}\n",
      count);
  for (const std::string_view column : columns)
    header += fmt::format("property float {}\n", column);
  return header + "end_header\n";
}

Error notOurs(const std::filesystem::path& path, std::string_view where) {
  return badInput(fmt::format(
      "{}: {}. Receivers are read as 'lambent shade' and 'lambent reference' write them: .ply or "
      ".csv with the columns x,y,z,nx,ny,nz,r,g,b and perhaps vr,vg,vb",
      path.string(), where));
}

Result<ReceiverFile> parsePly(std::string_view bytes, const std::filesystem::path& path) {
  constexpr std::string_view kElement = "element vertex ", kEnd = "end_header\n";
  const std::size_t element = bytes.find(kElement), end = bytes.find(kEnd);
  if (element == bytes.npos || end == bytes.npos || element > end)
    return notOurs(path, "no vertex element in the header");
  std::size_t count = 0;
  std::from_chars(bytes.data() + element + kElement.size(), bytes.data() + end, count);
  const std::string_view header = bytes.substr(0, end + kEnd.size());
  const bool variance = header == plyHeader(count, columnsOf(true));
  if (!variance && header != plyHeader(count, columnsOf(false)))
    return notOurs(path, "the header names other columns");
  const std::string_view body = bytes.substr(end + kEnd.size());
  const std::size_t rowBytes = columnsOf(variance).size() * sizeof(float);
  if (body.size() / rowBytes != count || body.size() % rowBytes != 0)
    return notOurs(path, fmt::format("the header promises {} rows of {} bytes, {} bytes follow",
                                     count, rowBytes, body.size()));
  ReceiverFile file;
  for (std::size_t i = 0; i < count; ++i) {
    Row row{};
    std::memcpy(row.data(), body.data() + i * rowBytes, rowBytes);
    add(file, row, variance);
  }
  return file;
}

Result<ReceiverFile> parseCsv(std::string_view text, const std::filesystem::path& path) {
  ReceiverFile file;
  std::size_t line = 0;
  bool variance = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (++line == 1) {
      variance = row == fmt::format("{}", fmt::join(columnsOf(true), ","));
      if (!variance && row != fmt::format("{}", fmt::join(columnsOf(false), ",")))
        return notOurs(path, "line 1 names other columns");
      continue;
    }
    Row values{};
    const char* at = row.data();
    const char* const rowEnd = row.data() + row.size();
    const std::size_t columns = columnsOf(variance).size();
    for (std::size_t i = 0; i < columns; ++i) {
      const auto [rest, error] = std::from_chars(at, rowEnd, values[i]);
      const bool last = i + 1 == columns;
      if (error != std::errc() || (last ? rest != rowEnd : rest == rowEnd || *rest != ','))
        return notOurs(path, fmt::format("line {}, column {} is not a number", line, i + 1));
      at = last ? rest : rest + 1;
    }
    add(file, values, variance);
  }
  return file;
}

}  // namespace

Status writeReceivers(const ReceiverFile& file, const std::filesystem::path& path) {
  const Columns columns = columnsOf(!file.variances.empty());
  std::string bytes;
  if (extensionOf(path) == ".csv") {
    bytes = fmt::format("{}\n", fmt::join(columns, ","));
    for (std::size_t i = 0; i < file.receivers.size(); ++i) {
      const Row row = rowOf(file, i);
      fmt::format_to(std::back_inserter(bytes), "{}\n",
                     fmt::join(std::span(row).first(columns.size()), ","));
    }
  } else {
    bytes = plyHeader(file.receivers.size(), columns);
    for (std::size_t i = 0; i < file.receivers.size(); ++i) {
      const Row row = rowOf(file, i);
      bytes.append(reinterpret_cast<const char*>(row.data()), columns.size() * sizeof(float));
    }
  }
  return file::writeAtomically(path, bytes);
}

Result<ReceiverFile> readReceivers(const std::filesystem::path& path,
                                   std::optional<std::uint64_t> memoryLimit) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const bool csv = extensionOf(path) == ".csv";
  // A row of text is a line; the other rows are held as they lie in the file.
  const std::uint64_t most =
      csv ? sizeof(Row) * (1 + std::uint64_t(std::count(text.begin(), text.end(), '\n')))
          : text.size();
  file::Budget budget(memoryLimit);
  budget.addFile(text.size());
  if (Status fits = budget.hold(most, path.string()); !fits) return fits.error();
  return csv ? parseCsv(text, path) : parsePly(text, path);
}

}  // namespace lambent::tool
