// PNG, JPEG and WebP files of every kind for tests. PNG is put together here, byte by byte, so that
// the reader is held to the specification and not to a writer; the others by their libraries.
#pragma once

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <vector>
// jpeglib.h wants stdio before it.
#include <jpeglib.h>
#include <webp/encode.h>

namespace lambent::image {

inline std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

inline std::string bigEndian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
  std::uint32_t c = 0xffffffffu;  // bit by bit: independent of the reader's table
  for (const char byte : type + data) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(~c);
}

struct PngKind {
  int depth = 8, type = 2;  ///< bits a sample; 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  bool interlaced = false;
  std::string palette, transparency;  ///< the data of PLTE and tRNS
};

inline int pngChannels(int type) {
  return type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1;
}

/// `sample(x, y, channel)` is below 2^depth. Deflate's blocks are stored, not packed.
inline std::string makePng(int width, int height, const PngKind& kind, const auto& sample) {
  std::string raw;
  const auto lines = [&](int x0, int y0, int dx, int dy) {
    if (x0 >= width) return;
    for (int y = y0; y < height; y += dy) {
      raw += '\0';  // no filter
      unsigned bits = 0, held = 0;
      for (int x = x0; x < width; x += dx) {
        for (int c = 0; c < pngChannels(kind.type); ++c) {
          bits = bits << kind.depth | sample(x, y, c);
          held += static_cast<unsigned>(kind.depth);
          while (held >= 8) raw += static_cast<char>(bits >> (held -= 8));
        }
      }
      if (held > 0) raw += static_cast<char>(bits << (8 - held));
    }
  };
  if (kind.interlaced) {  // Adam7
    lines(0, 0, 8, 8), lines(4, 0, 8, 8), lines(0, 4, 4, 8), lines(2, 0, 4, 4);
    lines(0, 2, 2, 4), lines(1, 0, 2, 2), lines(0, 1, 1, 2);
  } else {
    lines(0, 0, 1, 1);
  }
  std::uint32_t a = 1, b = 0;
  for (const char byte : raw) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto n = static_cast<unsigned>(raw.size());  // below 65536
  const std::string head{'\x78', '\x01', '\x01', char(n), char(n >> 8), char(~n), char(~n >> 8)};
  const std::string ihdr =
      bigEndian(static_cast<std::uint32_t>(width)) + bigEndian(static_cast<std::uint32_t>(height)) +
      std::string{char(kind.depth), char(kind.type), 0, 0, char(kind.interlaced)};
  std::string file = "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", ihdr);
  file += pngChunk("gAMA", bigEndian(45455)) + pngChunk("tEXt", "Comment");
  if (!kind.palette.empty()) file += pngChunk("PLTE", kind.palette);
  if (!kind.transparency.empty()) file += pngChunk("tRNS", kind.transparency);
  return file + pngChunk("IDAT", head + raw + bigEndian(b << 16 | a)) + pngChunk("IEND", "");
}

struct JpegKind {
  int components = 3;  ///< 1 grey, 3 colour, 4 ink (Adobe's, inverted)
  bool progressive = false;
};

/// `sample(x, y, channel)` is a code from 0 to 255.
inline std::string makeJpeg(int width, int height, const JpegKind& kind, const auto& sample) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &data, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = kind.components;
  jpeg.in_color_space = kind.components == 1   ? JCS_GRAYSCALE
                        : kind.components == 3 ? JCS_RGB
                                               : JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  if (kind.progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<unsigned char> row(size_t(width) * kind.components);
  for (int y = 0; y < height; ++y) {
    for (size_t i = 0; i < row.size(); ++i) {
      row[i] = static_cast<unsigned char>(
          sample(static_cast<int>(i) / kind.components, y, static_cast<int>(i) % kind.components));
    }
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string file(reinterpret_cast<const char*>(data), size);
  std::free(data);
  return file;
}

/// Lossless; `rgba` has four codes a pixel.
inline std::string makeWebP(int width, int height, const std::vector<std::uint8_t>& rgba) {
  std::uint8_t* data = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &data);
  std::string file(reinterpret_cast<const char*>(data), size);
  WebPFree(data);
  return file;
}

}  // namespace lambent::image
