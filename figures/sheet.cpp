#include "figures/sheet.h"

// The header's own buffers are small; its one function writes quads into ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>

namespace lambent::figures {

namespace {

constexpr int kGap = 6, kLetter = 2;
const Rgb kPaper = Rgb::Ones(), kInk = Rgb::Constant(0.03f);

}  // namespace

int textWidth(const std::string& text, int scale) {
  std::string copy = text;
  return scale * stb_easy_font_width(copy.data());
}

void drawText(image::Image& image, int x, int y, const std::string& text, int scale) {
  std::vector<float> quads(text.size() * 300 + 300);
  std::string copy = text;
  const int count = stb_easy_font_print(0, 0, copy.data(), nullptr, quads.data(),
                                        static_cast<int>(quads.size() * sizeof(float)));
  for (int q = 0; q < count; ++q) {
    const float* v = quads.data() + q * 16;  // four vertices of x, y, z, colour
    const int x0 = x + int(v[0]) * scale, y0 = y + int(v[1]) * scale;
    const int x1 = x + int(v[8]) * scale, y1 = y + int(v[9]) * scale;
    for (int py = std::max(0, y0); py < std::min(image.height, y1); ++py)
      for (int px = std::max(0, x0); px < std::min(image.width, x1); ++px) image.at(px, py) = kInk;
  }
}

image::Image compose(const Sheet& sheet) {
  int width = 1;
  std::size_t columns = sheet.columnLabels.size();
  std::vector<int> tops = {sheet.columnLabels.empty() ? 0 : 10 * kLetter + kGap};  // of rows
  for (const auto& row : sheet.rows) {
    columns = std::max(columns, row.size());
    int height = 1;
    for (const image::Image& cell : row)
      width = std::max(width, cell.width), height = std::max(height, cell.height);
    tops.push_back(tops.back() + height + kGap);
  }
  for (const std::string& label : sheet.columnLabels)
    width = std::max(width, textWidth(label, kLetter) + kGap);
  int left = 0;
  for (const std::string& label : sheet.rowLabels)
    left = std::max(left, textWidth(label, kLetter) + 2 * kGap);
  image::Image out(left + static_cast<int>(columns) * (width + kGap) + kGap, tops.back() + kGap);
  std::fill(out.pixels.begin(), out.pixels.end(), kPaper);
  for (std::size_t c = 0; c < sheet.columnLabels.size(); ++c) {
    const int centre = left + kGap + static_cast<int>(c) * (width + kGap) + width / 2;
    drawText(out, centre - textWidth(sheet.columnLabels[c], kLetter) / 2, kGap,
             sheet.columnLabels[c], kLetter);
  }
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    const int y = tops[r] + kGap;
    if (r < sheet.rowLabels.size())
      drawText(out, kGap, (tops[r] + tops[r + 1] + kGap) / 2 - 4 * kLetter, sheet.rowLabels[r],
               kLetter);
    for (std::size_t c = 0; c < sheet.rows[r].size(); ++c) {
      const image::Image& cell = sheet.rows[r][c];
      const int x = left + kGap + static_cast<int>(c) * (width + kGap) + (width - cell.width) / 2;
      for (int py = 0; py < cell.height; ++py)
        for (int px = 0; px < cell.width; ++px) out.at(x + px, y + py) = cell.at(px, py);
    }
  }
  return out;
}

}  // namespace lambent::figures
