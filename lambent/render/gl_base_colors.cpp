#include "lambent/render/gl_base_colors.h"

#include <fmt/format.h>

#include "lambent/radiometry/srgb.h"

namespace lambent::render {

namespace {

int wrapRule(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::ClampToEdge:
      return 1;
    case scene::Wrap::MirroredRepeat:
      return 2;
    case scene::Wrap::Repeat:
      break;
  }
  return 0;
}

}  // namespace

int GlBaseColors::textureOf(std::uint32_t mesh) const {
  const int texture = scene_->materials[scene_->meshes[mesh].material].baseColorTexture;
  if (scene_->meshes[mesh].uvs.empty() || texture < 0 ||
      std::size_t(texture) >= scene_->textures.size())
    return -1;
  const scene::Texture& t = scene_->textures[texture];
  const bool whole = t.width > 0 && t.height > 0 &&
                     t.rgba.size() >= 4 * std::size_t(t.width) * std::size_t(t.height);
  return whole ? texture : -1;
}

Status GlBaseColors::add(std::uint32_t mesh, int largestTexture) {
  if (!srgbTable_.name()) {
    std::vector<float> table(256);
    for (int i = 0; i < 256; ++i) table[i] = radiometry::srgbDecode(float(i) / 255.0f);
    srgbTable_ = makeBuffer(table);
  }
  const int index = textureOf(mesh);
  if (index < 0 || textures_.contains(index)) return Status::ok();
  const scene::Texture& from = scene_->textures[index];
  if (from.width > largestTexture || from.height > largestTexture)
    return report::failed(fmt::format(
        "texture {} '{}' has {}×{} texels, but this OpenGL takes {} a side. Make it smaller, or "
        "make the picture on the CPU",
        index, from.name, from.width, from.height, largestTexture));
  Texture texture = makeTexture(GL_RGBA8UI, from.width, from.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, from.width, from.height, GL_RGBA_INTEGER,
                      GL_UNSIGNED_BYTE, from.rgba.data());
  textures_.emplace(index, std::move(texture));
  return checkGl("uploading a base-colour texture");
}

void GlBaseColors::bindTable() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, srgbTable_.name());
}

void GlBaseColors::bindCoverage(const Program& program, std::uint32_t mesh, int sample) const {
  const scene::Material& material = scene_->materials[std::size_t(scene_->meshes[mesh].material)];
  const bool whole = !hasGaps(mesh);
  program.set("alphaMode", whole ? 0 : int(material.alphaMode));
  program.set("alphaRule", material.opacity, material.alphaCutoff);
  program.set("kept", whole ? 1.0f : std::clamp(1.0f - material.transmitted.mean(), 0.0f, 1.0f));
  program.set("veil", int(mesh), sample);
}

void GlBaseColors::bind(const Program& program, std::uint32_t mesh) const {
  const int texture = textureOf(mesh);
  program.set("hasTexture", int(texture >= 0));
  if (texture >= 0) {
    const scene::Texture& from = scene_->textures[texture];
    program.set("baseColorWrap", wrapRule(from.wrapU), wrapRule(from.wrapV));
  }
  glBindTextureUnit(0, texture >= 0 ? textures_.at(texture).name() : 0);
}

}  // namespace lambent::render
