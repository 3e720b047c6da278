// Radiance pictures, ward1991real: a text header, then scanlines of RGBE pixels (8-bit mantissas
// and one shared exponent), plain or run-length encoded in the old or the new way.
//
//   value = mantissa · 2^(exponent − 136), divided by every EXPOSURE and COLORCORR of the header
//
// PRIMARIES and XYZE become Rec. 709. Where the header says neither, colours are taken as Rec. 709:
// Radiance's own default differs from that by 0.01 in the green and an equal-energy white.
//
// Deviation: Radiance itself adds half a mantissa step when it decodes, which makes up for writers
// that truncate. The pictures in use come from everywhere and other readers (three.js among them)
// add nothing; neither do we, so that 1.0 stays 1.0, and our writer rounds instead of truncating.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// A line of one colour in old runs: 16 bytes for 65536 pixels; in new ones 8 bytes for 127.
constexpr size_t kMaxPixelsPerHdrByte = 4096;

/// The stretch of the file that is not read yet.
class Cursor {
 public:
  Cursor(Bytes bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  size_t left() const { return bytes_.size() - at_; }
  std::uint8_t peek(size_t ahead) const { return static_cast<std::uint8_t>(bytes_[at_ + ahead]); }
  std::uint8_t next() { return static_cast<std::uint8_t>(bytes_[at_++]); }
  Rgbe nextPixel() {
    Rgbe pixel;
    std::memcpy(pixel.data(), bytes_.data() + at_, 4);
    at_ += 4;
    return pixel;
  }
  /// A line without its end; nothing at the end of the file or if no line ends within 64 KiB.
  std::optional<std::string_view> nextLine() {
    const size_t window = std::min<size_t>(left(), 65536);
    const void* const end = window ? std::memchr(bytes_.data() + at_, '\n', window) : nullptr;
    if (!end) return std::nullopt;
    const size_t length = static_cast<const std::byte*>(end) - (bytes_.data() + at_);
    std::string_view line(reinterpret_cast<const char*>(bytes_.data()) + at_, length);
    at_ += length + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  Error damaged(const std::string& what) const {
    return report::badInput(std::string(name_) + ": " + what + " at byte " + std::to_string(at_) +
                            "; the file is damaged or cut off");
  }

 private:
  Bytes bytes_;
  std::string_view name_;
  size_t at_ = 0;
};

struct Header {
  bool xyz = false;
  std::optional<radiometry::Primaries> primaries;
  Findings findings;
  std::array<double, 3> divisor{1, 1, 1};
  // Slow axis first, as the file has it: "-Y 256 +X 512".
  char slow = 'Y', fast = 'X';
  bool slowRises = false, fastRises = true;  ///< the sign; +Y is up, +X right
  int slowSize = 0, fastSize = 0;
  /// From the top left, line by line, exposed once.
  bool isPlain() const {
    return slow == 'Y' && !slowRises && fastRises && divisor == std::array<double, 3>{1, 1, 1};
  }
  int width() const { return slow == 'X' ? slowSize : fastSize; }
  int height() const { return slow == 'X' ? fastSize : slowSize; }
};

/// Numbers with blanks between them, up to something that is no number. A decimal point is a point
/// in every locale.
std::vector<double> numbersIn(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    while (!text.empty() && (text[0] == ' ' || text[0] == '\t')) text.remove_prefix(1);
    std::string_view digits = text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument) return numbers;
    numbers.push_back(error == std::errc() ? value : 0.0);  // beyond the range of a double: no use
    text.remove_prefix(static_cast<size_t>(end - text.data()));
  }
}

void divideBy(Header& header, const std::vector<double>& factors) {
  for (const double f : factors) {
    if (!(f > 0) || !std::isfinite(f)) return;  // a writer's slip; the pixels are usable without
  }
  if (factors.size() == 1) {
    for (double& d : header.divisor) d *= factors[0];
  } else if (factors.size() == 3) {
    for (int c = 0; c < 3; ++c) header.divisor[c] *= factors[c];
  }
}

/// "PRIMARIES= .640 .330 .290 .600 .150 .060 .333 .333": red, green, blue, white.
void readPrimaries(const std::vector<double>& xy, std::string_view name, Header& header) {
  if (xy.size() == 8) {
    header.primaries = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
    if (rec709From(*header.primaries)) return;
    header.primaries.reset();
  }
  header.findings.push_back(
      {Severity::Warning, "colour-primaries",
       fmt::format("{}: its PRIMARIES are not eight numbers that span a triangle; "
                   "its colours are taken as mixtures of those of Rec. 709",
                   name),
       1, true});
}

/// What is said but not used.
void readUnused(std::string_view line, std::string_view name, Header& header) {
  const auto differs = [&](std::string_view key) {
    if (!line.starts_with(key)) return false;
    const std::vector<double> value = numbersIn(line.substr(key.size()));
    return value.size() != 1 || std::abs(value[0] - 1.0) > 1e-3;
  };
  if (differs("GAMMA="))
    header.findings.push_back(
        {Severity::Warning, "colour-not-linear",
         fmt::format("{}: says {}; numbers of this format are linear, and it is not "
                     "used: if they are encoded, save the picture linear",
                     name, line.substr(0, 40)),
         1, true});
  if (differs("PIXASPECT="))
    header.findings.push_back(
        {Severity::Note, "pixel-aspect",
         fmt::format("{}: says {}; the picture is not stretched", name, line.substr(0, 40)), 1,
         true});
}

bool parseResolution(std::string_view line, Header& header) {
  const auto axis = [&](char& letter, bool& rises, int& size) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (line.size() < 2 || (line[0] != '-' && line[0] != '+')) return false;
    if (line[1] != 'X' && line[1] != 'Y') return false;
    rises = line[0] == '+';
    letter = line[1];
    line.remove_prefix(2);
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), size);
    if (parsed.ec != std::errc()) return false;
    line.remove_prefix(parsed.ptr - line.data());
    return true;
  };
  return axis(header.slow, header.slowRises, header.slowSize) &&
         axis(header.fast, header.fastRises, header.fastSize) && header.slow != header.fast;
}

Result<Header> readHeader(Cursor& file, std::string_view name) {
  Header header;
  (void)file.nextLine();  // "#?RADIANCE" or "#?RGBE": isHdr() has seen it
  for (;;) {
    const std::optional<std::string_view> line = file.nextLine();
    if (!line) return file.damaged("the header does not end");
    if (line->empty()) break;
    if (line->starts_with("FORMAT=")) {
      if (line->find("32-bit_rle_xyze") != std::string_view::npos) {
        header.xyz = true;
      } else if (line->find("32-bit_rle_rgbe") == std::string_view::npos) {
        return report::badInput(std::string(name) + ": " + std::string(line->substr(0, 80)) +
                                " is not a known pixel format; save it as 32-bit_rle_rgbe");
      }
    } else if (line->starts_with("EXPOSURE=")) {
      const std::vector<double> one = numbersIn(line->substr(9));
      if (one.size() == 1) divideBy(header, one);
    } else if (line->starts_with("COLORCORR=")) {
      divideBy(header, numbersIn(line->substr(10)));
    } else if (line->starts_with("PRIMARIES=")) {
      readPrimaries(numbersIn(line->substr(10)), name, header);
    } else {
      readUnused(*line, name, header);
    }
  }
  const std::optional<std::string_view> resolution = file.nextLine();
  if (!resolution || !parseResolution(*resolution, header)) {
    return file.damaged("no picture size such as \"-Y 256 +X 512\"");
  }
  return header;
}

/// The new way: each of the four components of a scanline by itself, in runs (128 + n, value) and
/// dumps (n, values …), 1 ≤ n ≤ 127 or 128.
Status readNewRuns(Cursor& file, std::span<Rgbe> row) {
  for (int component = 0; component < 4; ++component) {
    size_t x = 0;
    while (x < row.size()) {
      if (file.left() < 2) return file.damaged("the pixels end too early");
      const unsigned code = file.next();
      const unsigned count = code > 128 ? code - 128 : code;
      if (count == 0 || count > row.size() - x) return file.damaged("a run does not fit its line");
      if (code > 128) {
        const std::uint8_t value = file.next();
        for (unsigned i = 0; i < count; ++i) row[x++][component] = value;
      } else {
        if (file.left() < count) return file.damaged("the pixels end too early");
        for (unsigned i = 0; i < count; ++i) row[x++][component] = file.next();
      }
    }
  }
  return Status::ok();
}

/// Plain pixels, among which (1, 1, 1, n) repeats the pixel before n times, n counted in steps of
/// 256 more for each such code that follows another directly.
Status readOldRuns(Cursor& file, std::span<Rgbe> row) {
  size_t x = 0;
  unsigned shift = 0;
  while (x < row.size()) {
    if (file.left() < 4) return file.damaged("the pixels end too early");
    const Rgbe pixel = file.nextPixel();
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      if (x == 0 || shift > 24) return file.damaged("a run repeats nothing");
      const size_t count = size_t(pixel[3]) << shift;
      if (count > row.size() - x) return file.damaged("a run does not fit its line");
      for (size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
  }
  return Status::ok();
}

Status readLine(Cursor& file, std::span<Rgbe> row) {
  if (row.size() >= 8 && row.size() < 32768 && file.left() >= 4 && file.peek(0) == 2 &&
      file.peek(1) == 2 && file.peek(2) < 128) {
    const size_t length = size_t(file.peek(2)) << 8 | file.peek(3);
    if (length != row.size()) return file.damaged("a line says another length than the header");
    (void)file.nextPixel();
    return readNewRuns(file, row);
  }
  return readOldRuns(file, row);
}

Rgb decodePixel(const Rgbe& pixel, const Header& header) {
  if (pixel[3] == 0) return Rgb::Zero();
  const double scale = std::ldexp(1.0, pixel[3] - 136);
  std::array<double, 3> v;
  for (int c = 0; c < 3; ++c) v[c] = pixel[c] * scale / header.divisor[c];
  return Rgb(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
}

Rgbe encodePixel(const Rgb& value) {
  Rgb v;
  for (int c = 0; c < 3; ++c) v[c] = value[c] > 0.0f ? std::min(value[c], 1.6e38f) : 0.0f;
  const float largest = v.maxCoeff();
  if (largest < 1e-32f) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (std::lround(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
  Rgbe pixel;
  for (int c = 0; c < 3; ++c) {
    pixel[c] = static_cast<std::uint8_t>(std::lround(std::ldexp(v[c], 8 - exponent)));
  }
  pixel[3] = static_cast<std::uint8_t>(exponent + 128);
  return pixel;
}

void writeRuns(std::span<const Rgbe> row, int component, std::vector<std::byte>& out) {
  const auto put = [&](unsigned value) { out.push_back(static_cast<std::byte>(value)); };
  const auto runAt = [&](size_t x) {
    size_t n = 1;
    while (n < 127 && x + n < row.size() && row[x + n][component] == row[x][component]) ++n;
    return n;
  };
  size_t x = 0;
  while (x < row.size()) {
    if (const size_t run = runAt(x); run >= 4) {
      put(static_cast<unsigned>(128 + run));
      put(row[x][component]);
      x += run;
      continue;
    }
    size_t end = x + 1;
    while (end < row.size() && end - x < 128 && runAt(end) < 4) ++end;
    put(static_cast<unsigned>(end - x));
    for (; x < end; ++x) put(row[x][component]);
  }
}

}  // namespace

bool isHdr(Bytes bytes) {
  return bytes.size() >= 2 && bytes[0] == std::byte('#') && bytes[1] == std::byte('?');
}

Result<PictureFile> readHdr(Bytes bytes, std::string_view name, file::Budget& budget) {
  Cursor file(bytes, name);
  Result<Header> header = readHeader(file, name);
  if (!header) return header.error();
  if (Status sane =
          checkSize(header->width(), header->height(), bytes.size(), name, kMaxPixelsPerHdrByte);
      !sane) {
    return sane.error();
  }
  if (Status fits = holdPixels(header->width(), header->height(), sizeof(Rgb), name, budget);
      !fits) {
    return fits.error();
  }
  Image image(header->width(), header->height());
  std::vector<Rgbe> line(header->fastSize);
  for (int s = 0; s < header->slowSize; ++s) {
    if (Status read = readLine(file, line); !read) return read.error();
    for (int f = 0; f < header->fastSize; ++f) {
      const int column = header->slow == 'X' ? s : f;
      const int row = header->slow == 'X' ? f : s;
      const bool right = header->slow == 'X' ? header->slowRises : header->fastRises;
      const bool up = header->slow == 'X' ? header->fastRises : header->slowRises;
      image.at(right ? column : image.width - 1 - column, up ? image.height - 1 - row : row) =
          decodePixel(line[f], *header);
    }
  }
  PictureFile picture;
  if (header->xyz) header->primaries = radiometry::xyzPrimaries();
  picture.converted = !header->isPlain();
  if (header->primaries && toRec709(*header->primaries, image)) picture.converted = true;
  picture.image = std::move(image);
  picture.findings = std::move(header->findings);
  return picture;
}

std::vector<std::byte> writeHdr(const Image& image) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                             std::to_string(image.height) + " +X " + std::to_string(image.width) +
                             "\n";
  std::vector<std::byte> out(header.size());
  std::memcpy(out.data(), header.data(), header.size());
  const bool runs = image.width >= 8 && image.width < 32768;
  std::vector<Rgbe> row(image.width);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) row[x] = encodePixel(image.at(x, y));
    if (runs) {
      for (const int value : {2, 2, image.width >> 8, image.width & 255}) {
        out.push_back(static_cast<std::byte>(value));
      }
      for (int component = 0; component < 4; ++component) writeRuns(row, component, out);
    } else {
      for (const Rgbe& pixel : row) {
        for (const std::uint8_t value : pixel) out.push_back(static_cast<std::byte>(value));
      }
    }
  }
  return out;
}

}  // namespace lambent::image::formats
