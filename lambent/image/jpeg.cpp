// JPEG by libjpeg-turbo. What the library calls a warning (data that end too early, codes that no
// table has) is an error here: it would fill in grey and go on. Errors leave the library by
// longjmp, so the functions that call setjmp hold nothing that has a destructor.
#include <csetjmp>
#include <cstdio>
#include <cstring>
// jpeglib.h wants stdio before it.
#include <jpeglib.h>

#include <jerror.h>

#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

// A progressive scan skips 32767 blocks of 64 pixels in three bytes, but the first scan spends a
// bit on every block.
constexpr size_t kMaxPixelsPerJpegByte = 16384;

/// Every scan of a progressive file goes over the whole picture, in however few bytes; encoders
/// make about ten.
constexpr int kMostScans = 100;

struct Decoder {
  Decoder() {
    library.err = jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr common) { leave(common); };
    errors.output_message = [](j_common_ptr) {};
    errors.emit_message = [](j_common_ptr common, int level) {
      if (level < 0 && !isHarmless(common->err->msg_code)) leave(common);
    };
    progress.progress_monitor = [](j_common_ptr common) {
      if (reinterpret_cast<j_decompress_ptr>(common)->input_scan_number <= kMostScans) return;
      Decoder& self = *static_cast<Decoder*>(common->client_data);
      std::snprintf(self.reason, sizeof self.reason, "it has more than %d scans", kMostScans);
      std::longjmp(self.out, 1);
    };
    library.client_data = this;
  }
  ~Decoder() { jpeg_destroy_decompress(&library); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  static bool isHarmless(int code) {
    return code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM ||
           code == JWRN_BOGUS_ICC;
  }
  [[noreturn]] static void leave(j_common_ptr common) {
    Decoder& self = *static_cast<Decoder*>(common->client_data);
    common->err->format_message(common, self.reason);
    self.outOfMemory = common->err->msg_code == JERR_OUT_OF_MEMORY;
    std::longjmp(self.out, 1);
  }

  jpeg_decompress_struct library{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf out;
  char reason[JMSG_LENGTH_MAX] = "";
  bool outOfMemory = false;
};

bool readHeader(Decoder& decoder, Bytes bytes) {
  if (setjmp(decoder.out)) return false;
  jpeg_create_decompress(&decoder.library);
  decoder.library.client_data = &decoder;
  decoder.library.progress = &decoder.progress;
  jpeg_mem_src(&decoder.library, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder.library, TRUE);
  decoder.library.out_color_space = decoder.library.num_components == 4 ? JCS_CMYK : JCS_EXT_RGBA;
  return true;
}

bool readPixels(Decoder& decoder, std::uint8_t* rgba) {
  if (setjmp(decoder.out)) return false;
  jpeg_start_decompress(&decoder.library);
  const size_t stride = 4 * size_t(decoder.library.output_width);
  while (decoder.library.output_scanline < decoder.library.output_height) {
    JSAMPROW row = rgba + decoder.library.output_scanline * stride;
    jpeg_read_scanlines(&decoder.library, &row, 1);
  }
  jpeg_finish_decompress(&decoder.library);  // asks for the end marker
  return true;
}

/// Ink to light, as far as this goes without a profile. Adobe's files hold 255 − ink.
void fromInk(std::span<std::uint8_t> cmyk, bool inverted) {
  const auto product = [](unsigned a, unsigned b) {  // a·b/255, rounded
    const unsigned t = a * b + 128;
    return static_cast<std::uint8_t>((t + (t >> 8)) >> 8);
  };
  for (size_t i = 0; i + 3 < cmyk.size(); i += 4) {
    for (size_t c = 0; c < 3; ++c) {
      const unsigned ink = cmyk[i + c], key = cmyk[i + 3];
      cmyk[i + c] = inverted ? product(ink, key) : product(255 - ink, 255 - key);
    }
    cmyk[i + 3] = 255;
  }
}

/// Whether a text stands anywhere in the file, as it is or with a zero before each letter, as ICC
/// profiles write names.
bool holdsText(Bytes bytes, std::string_view text) {
  std::string wide;
  for (const char c : text) wide += std::string{'\0', c};
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return all.find(text) != std::string_view::npos || all.find(wide) != std::string_view::npos;
}

}  // namespace

bool isJpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{0xff} && bytes[1] == std::byte{0xd8} &&
         bytes[2] == std::byte{0xff};
}

Result<Codes> readJpeg(Bytes bytes, std::string_view name, file::Budget& budget) {
  Decoder decoder;
  const auto undecodable = [&] {
    if (decoder.outOfMemory) throw std::bad_alloc();
    // Where the block begins that was being read; at the end of the file the library may stand in
    // an end marker of its own making.
    const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
    const jpeg_source_mgr* const source = decoder.library.src;
    size_t at = bytes.size();
    if (source && decoder.errors.msg_code != JWRN_JPEG_EOF && source->next_input_byte >= first &&
        source->next_input_byte <= first + bytes.size()) {
      at = static_cast<size_t>(source->next_input_byte - first);
    }
    return damaged(name, std::string("cannot be decoded: ") + decoder.reason, at);
  };
  if (!readHeader(decoder, bytes)) return undecodable();
  const jpeg_decompress_struct& jpeg = decoder.library;
  if (Status sane =
          checkSize(jpeg.image_width, jpeg.image_height, bytes.size(), name, kMaxPixelsPerJpegByte);
      !sane) {
    return sane.error();
  }
  // A picture in several scans is kept as two-byte coefficients until the last one.
  const size_t forScans =
      jpeg_has_multiple_scans(&decoder.library) ? 2 * static_cast<size_t>(jpeg.num_components) : 0;
  if (Status fits = holdPixels(jpeg.image_width, jpeg.image_height, 4 + forScans, name, budget);
      !fits) {
    return fits.error();
  }
  Codes codes;
  codes.width = static_cast<int>(jpeg.image_width);
  codes.height = static_cast<int>(jpeg.image_height);
  const size_t pixels = size_t(jpeg.image_width) * jpeg.image_height;
  codes.rgba8.resize(4 * pixels);
  if (!readPixels(decoder, codes.rgba8.data())) return undecodable();
  if (jpeg.out_color_space == JCS_CMYK) fromInk(codes.rgba8, jpeg.saw_Adobe_marker);
  budget.release(forScans * pixels);
  if (holdsText(bytes, "ICC_PROFILE") && !holdsText(bytes, "sRGB")) codes.colour.profile = "ICC";
  return codes;
}

}  // namespace lambent::image::formats
