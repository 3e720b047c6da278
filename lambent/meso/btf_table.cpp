#include "lambent/meso/btf_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "lambent/file/atomic_file.h"

namespace lambent::meso {

namespace {

constexpr std::array<std::string_view, 5> kColumns = {"file", "view_theta", "view_phi",
                                                      "light_theta", "light_phi"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

Vec3 directionOf(double thetaDegrees, double phiDegrees) {
  const double theta = thetaDegrees * kPi / 180.0, phi = phiDegrees * kPi / 180.0;
  return Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta))
      .cast<float>();
}

}  // namespace

Result<std::vector<BtfSample>> readBtfTable(const std::filesystem::path& path) {
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // a byte order mark

  std::vector<BtfSample> samples;
  std::array<std::size_t, kColumns.size()> column{};
  bool hasHeader = false;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    const std::string where = path.string() + ", line " + std::to_string(number) + ": ";
    const std::vector<std::string_view> fields = fieldsOf(line);
    if (!hasHeader) {
      for (std::size_t c = 0; c < kColumns.size(); ++c) {
        column[c] = fields.size();
        for (std::size_t f = 0; f < fields.size(); ++f)
          if (fields[f] == kColumns[c]) column[c] = f;
        if (column[c] == fields.size())
          return report::badInput(where + "the header has no column \"" + std::string(kColumns[c]) +
                                  "\"; it wants file, view_theta, view_phi, light_theta, "
                                  "light_phi, separated by commas");
      }
      hasHeader = true;
      continue;
    }
    std::array<double, 4> angles{};
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
      const std::string name(kColumns[c]);
      if (column[c] >= fields.size() || fields[column[c]].empty())
        return report::badInput(where + "nothing in column \"" + name + "\"");
      if (c == 0) continue;
      const std::string_view text = fields[column[c]];
      double& value = angles[c - 1];
      const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
        return report::badInput(where + "\"" + std::string(text) + "\" in column \"" + name +
                                "\" is not a number of degrees");
      const bool isTheta = c % 2 == 1;
      if (isTheta && !(value >= 0.0 && value < 90.0))
        return report::badInput(where + name + " is " + std::string(text) +
                                "; it is the angle from the normal, from 0 to below 90 degrees");
    }
    BtfSample sample;
    sample.file = path.parent_path() / std::filesystem::path(std::string(fields[column[0]]));
    sample.view = directionOf(angles[0], angles[1]);
    sample.light = directionOf(angles[2], angles[3]);
    sample.line = number;
    samples.push_back(std::move(sample));
  }
  if (!hasHeader) return report::badInput(path.string() + ": the table is empty");
  return samples;
}

Result<std::filesystem::path> findBtfTable(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return path;
  std::vector<std::filesystem::path> tables;
  for (std::filesystem::directory_iterator it(path, error), end; !error && it != end;
       it.increment(error))
    if (it->path().extension() == ".csv") tables.push_back(it->path());
  if (error) return report::badInput(path.string() + ": cannot be listed: " + error.message());
  if (tables.size() == 1) return tables.front();
  return report::badInput(path.string() + (tables.empty()
                                               ? ": there is no .csv that says which picture has "
                                                 "which view and light"
                                               : ": there are several .csv files; name the one"));
}

}  // namespace lambent::meso
