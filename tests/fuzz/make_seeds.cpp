// lambent_fuzz_seeds FOLDER: writes the seeds that nobody writes by hand into FOLDER/TARGET. They
// lie in corpus/; this made them.
#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledRgbaFile.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "lambent/asset/rtt_file.h"
#include "lambent/image/io.h"
#include "lambent/image/test_codecs.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/test_compressed.h"
#include "lambent/transfer/encode.h"

namespace {

using namespace lambent;
using Path = std::filesystem::path;

unsigned pattern(int x, int y, int c) {
  return unsigned(x * 37 + y * 59 + c * 83 + x * y) & 255u;
}

void save(const Path& path, std::string_view bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

void pngs(const Path& folder) {
  const std::string colours = "\xff\x80\x40\x10\x20\x30\x01\xfe\x7f\x55\xaa\x33";
  const auto save8 = [&](const char* name, int depth, int type, bool interlaced,
                         const std::string& palette, const std::string& transparency) {
    image::PngKind kind{depth, type, interlaced, palette, transparency};
    const unsigned mask = palette.empty() ? (1u << depth) - 1 : 3u;
    save(folder / name, image::makePng(6, 3, kind, [&](int x, int y, int c) {
           return (pattern(x, y, c) * 257u) & mask;
         }));
  };
  save8("grey1.png", 1, 0, false, "", "");
  save8("grey16_key.png", 16, 0, false, "", std::string("\0\7", 2));
  save8("rgb8.png", 8, 2, false, "", "");
  save8("rgb16_key.png", 16, 2, false, "", std::string("\0\1\0\2\0\3", 6));
  save8("palette2.png", 2, 3, false, colours, std::string("\x80\xff", 2));
  save8("palette8.png", 8, 3, true, colours, "");
  save8("grey_alpha8.png", 8, 4, false, "", "");
  save8("rgba8.png", 8, 6, true, "", "");
  save8("rgba16.png", 16, 6, false, "", "");
}

void jpegs(const Path& folder) {
  for (const int components : {1, 3, 4}) {
    for (const bool progressive : {false, true}) {
      const std::string name =
          std::to_string(components) + (progressive ? "_progressive.jpg" : "_baseline.jpg");
      save(folder / name, image::makeJpeg(16, 8, {components, progressive}, pattern));
    }
  }
}

void webps(const Path& folder) {
  std::vector<std::uint8_t> rgba;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 4; ++c) rgba.push_back(std::uint8_t(pattern(x, y, c)));
    }
  }
  save(folder / "lossless.webp", image::makeWebP(16, 8, rgba));
  std::uint8_t* data = nullptr;
  std::size_t size = WebPEncodeRGBA(rgba.data(), 16, 8, 64, 60.0f, &data);
  save(folder / "lossy_alpha.webp", {reinterpret_cast<const char*>(data), size});
  WebPFree(data);
  for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
  size = WebPEncodeRGBA(rgba.data(), 16, 8, 64, 20.0f, &data);
  save(folder / "lossy.webp", {reinterpret_cast<const char*>(data), size});
  WebPFree(data);
}

image::Image pictureOf(int width, int height) {
  image::Image picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = float(pattern(x, y, c)) / 64.0f;
    }
  }
  return picture;
}

void exrs(const Path& folder) {
  std::filesystem::create_directories(folder);
  const image::Image picture = pictureOf(8, 4);
  std::vector<Imf::Rgba> pixels;
  for (const Rgb& p : picture.pixels) pixels.emplace_back(p[0], p[1], p[2], 0.5f);
  const auto scanlines = [&](const char* name, Imf::Compression compression,
                             Imf::RgbaChannels channels) {
    Imf::Header header(8, 4);
    header.compression() = compression;
    Imf::RgbaOutputFile file((folder / name).c_str(), header, channels);
    file.setFrameBuffer(pixels.data(), 1, 8);
    file.writePixels(4);
  };
  scanlines("none.exr", Imf::NO_COMPRESSION, Imf::WRITE_RGBA);
  scanlines("rle.exr", Imf::RLE_COMPRESSION, Imf::WRITE_RGB);
  scanlines("zips.exr", Imf::ZIPS_COMPRESSION, Imf::WRITE_RGB);
  scanlines("piz.exr", Imf::PIZ_COMPRESSION, Imf::WRITE_RGB);
  scanlines("pxr24.exr", Imf::PXR24_COMPRESSION, Imf::WRITE_RGB);
  scanlines("b44a.exr", Imf::B44A_COMPRESSION, Imf::WRITE_RGB);
  scanlines("dwaa.exr", Imf::DWAA_COMPRESSION, Imf::WRITE_RGB);
  scanlines("luminance.exr", Imf::ZIP_COMPRESSION, Imf::WRITE_Y);
  scanlines("chroma.exr", Imf::ZIP_COMPRESSION, Imf::WRITE_YC);
  {
    Imf::Header header(8, 4);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::TiledRgbaOutputFile file((folder / "tiles.exr").c_str(), header, Imf::WRITE_RGB, 4, 4,
                                  Imf::ONE_LEVEL);
    file.setFrameBuffer(pixels.data(), 1, 8);
    file.writeTiles(0, 1, 0, 0);
  }
  image::WriteOptions options;
  options.layers.emplace_back("variance", &picture);
  (void)image::write(picture, folder / "layers.exr", options);
  Imf::Header header(8, 4);
  header.dataWindow() = Imath::Box2i({2, -1}, {9, 2});
  header.displayWindow() = Imath::Box2i({0, 0}, {7, 3});
  Imf::RgbaOutputFile file((folder / "windows.exr").c_str(), header, Imf::WRITE_RGBA);
  file.setFrameBuffer(pixels.data() - 2 + 8, 1, 8);
  file.writePixels(4);
}

void rtts(const Path& folder) {
  std::filesystem::create_directories(folder);
  transfer::SimulatedRtt rtt;
  rtt.name = "stripes";
  rtt.width = 3, rtt.height = 2, rtt.views = 2, rtt.bands = 2;
  rtt.values.resize(rtt.coefficientCount() * rtt.planeSize());
  for (std::size_t i = 0; i < rtt.values.size(); ++i) rtt.values[i] = float(i % 17) / 17.0f - 0.3f;
  using transfer::Encoding;
  for (const auto& [name, encoding] :
       {std::pair("float16.rtt", Encoding::Float16), std::pair("float32.rtt", Encoding::Float32),
        std::pair("snorm8.rtt", Encoding::Snorm8)}) {
    (void)asset::writeRtt(transfer::encode(rtt, encoding), folder / name);
  }
}

/// Compressed by Draco and by meshoptimizer.
void gltfs(const Path& folder) {
  std::filesystem::create_directories(folder);
  const scene::Mesh mesh = scene::box(Vec3::Ones(), 1);
  for (const auto& [method, name] :
       {std::pair(draco::MESH_SEQUENTIAL_ENCODING, "draco_sequential.glb"),
        std::pair(draco::MESH_EDGEBREAKER_ENCODING, "draco_edgebreaker.glb")}) {
    scene_io::GltfDocument d;
    scene_io::addDraco(d, scene_io::dracoOf(mesh, method), mesh.positions.size(),
                       mesh.triangles.size());
    const std::vector<std::byte> glb = *d.gltf.glb();
    save(folder / name, {reinterpret_cast<const char*>(glb.data()), glb.size()});
  }
  scene_io::MeshoptDocument packed;
  packed.addMesh(mesh);
  packed.write(folder / "meshopt.gltf");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: lambent_fuzz_seeds FOLDER\n");
    return 2;
  }
  const Path folder = argv[1];
  pngs(folder / "png");
  jpegs(folder / "jpeg");
  webps(folder / "webp");
  exrs(folder / "exr");
  rtts(folder / "rtt");
  gltfs(folder / "gltf");
  std::filesystem::create_directories(folder / "hdr");
  (void)image::write(pictureOf(16, 8), folder / "hdr" / "runs.hdr");
  (void)image::write(pictureOf(4, 2), folder / "hdr" / "narrow.hdr");
  return 0;
}
