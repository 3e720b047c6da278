#include "lambent/render/gl_scene.h"

#include <string>

#include "lambent/render/shader_sources.h"

namespace lambent::render {

bool GlScene::isPatched(std::uint32_t mesh) const {
  using transfer::Numbers;
  return std::visit(transfer::ForEachKind{[](const transfer::NoTransfer&) { return false; },
                                          [](const transfer::Surface<Numbers>&) { return false; },
                                          [](const transfer::BiScale<Numbers>&) { return true; }},
                    asset_->transfer.meshes[mesh]) &&
         !asset_->scene.materials[asset_->scene.meshes[mesh].material].isMirror();
}

Status GlScene::addAll() {
  GLuint vertexArray = 0;
  glCreateVertexArrays(1, &vertexArray);
  noAttributes_ = VertexArray(vertexArray);
  for (std::uint32_t mesh = 0; mesh < asset_->scene.meshes.size(); ++mesh) {
    if (Status s = colors_.add(mesh, options_.largestTexture); !s) return s;
    if (Status s = isPatched(mesh) ? patches_.add(mesh, transfer_)
                                   : surfaces_.add(mesh, options_.showing, transfer_);
        !s)
      return s;
  }
  return Status::ok();
}

Result<GlScene> GlScene::make(const asset::Asset& asset, const GlSceneOptions& options) {
  GlScene scene(asset, options, TransferOnGpu::Residence::Keep, nullptr);
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "unlit.vert.glsl", {std::string(shaderSource("unlit.vert.glsl"))}},
      {GL_FRAGMENT_SHADER,
       "unlit.frag.glsl",
       {"#define LAMBENT_MAP 1", std::string(shaderSource("base_color.glsl")),
        std::string(shaderSource("coverage.glsl")),
        std::string(shaderSource("base_color_map.glsl")),
        std::string(shaderSource("unlit.frag.glsl"))}}};
  Result<Program> unlit = Program::make(stages);
  if (!unlit) return unlit.error();
  scene.unlit_ = std::move(*unlit);
  if (Status s = scene.addAll(); !s) return s.error();
  return scene;
}

Result<GlScene> GlScene::makeLit(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                 const GlSceneOptions& options) {
  std::shared_ptr<GlAir> air;
  if (options.air) {
    Result<GlAir> made = GlAir::make(*options.air, options.largestTexture);
    if (!made) return made.error();
    air = std::make_shared<GlAir>(std::move(*made));
  }
  GlScene scene(asset, options, TransferOnGpu::Residence::Stream, std::move(air));
  scene.transfer_.setLight(light);
  if (options.sunShare) {
    scene.transfer_.setSunShare(options.sunShare);
    scene.surfaces_.setSharpSun(true);
  }
  if (Status s = scene.addAll(); !s) return s.error();
  return scene;
}

Status GlScene::retransfer(const shade::Showing& showing) {
  auto ofSurfaces = surfaces_.lightUnder(showing, transfer_);
  if (!ofSurfaces) return ofSurfaces.error();
  auto ofPatches = patches_.lightUnder(showing, transfer_);
  if (!ofPatches) return ofPatches.error();
  surfaces_.setLight(std::move(*ofSurfaces));
  patches_.setLight(std::move(*ofPatches));
  return Status::ok();
}

Status GlScene::choose(const shade::Showing& showing) {
  const shade::Showing before = options_.showing;
  if (Status s = patches_.choose(showing); !s) return s;
  if (showing.surfaces != before.surfaces || showing.mesoStructure != before.mesoStructure) {
    if (Status s = retransfer(showing); !s) {
      // The filter and what it needs were there before.
      (void)patches_.choose(before);
      return s;
    }
  } else if (showing.lobeExponent != before.lobeExponent || showing.softLobes != before.softLobes) {
    surfaces_.setLobe(showing);
  }
  options_.showing = showing;
  return Status::ok();
}

Status GlScene::setLightField(const capture::Blending& blending, GLuint lights, int bands) {
  Status status = Status::ok();
  forEachRelit([&](std::uint32_t mesh, Relit& relit) {
    if (status) status = TransferOnGpu::setBlend(relit, blending.meshes[mesh]);
  });
  if (!status) return status;
  return transfer_.setField(lights, bands);
}

Status GlScene::relight() {
  Status status = Status::ok();
  // What draws still read, or what a pass of the caller's has just written.
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  forEachRelit([&](std::uint32_t, Relit& relit) {
    if (status) status = transfer_.relight(relit);
  });
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  mirrorsStale_ = true;
  if (!status) return status;
  return checkGl("applying transfer to the light");
}

Status GlScene::setSunShare(const std::optional<sh::RgbCoefficients>& share) {
  transfer_.setSunShare(share);
  if (share.has_value() == sharpSun_) return Status::ok();
  surfaces_.setSharpSun(share.has_value());
  auto ofSurfaces = surfaces_.lightUnder(options_.showing, transfer_);
  if (!ofSurfaces) {
    surfaces_.setSharpSun(sharpSun_);
    return ofSurfaces.error();
  }
  surfaces_.setLight(std::move(*ofSurfaces));
  sharpSun_ = share.has_value();
  return Status::ok();
}

Status GlScene::setAir(const std::optional<shade::Air>& air) {
  if (!air && !air_) return Status::ok();
  environmentStale_ = true;  // mirrors in mirrors are seen through it
  if (air && air_ && air_->takes(*air)) return air_->set(*air);
  std::shared_ptr<GlAir> next;
  if (air) {
    Result<GlAir> made = GlAir::make(*air, options_.largestTexture);
    if (!made) return made.error();
    next = std::make_shared<GlAir>(std::move(*made));
  }
  if (Status s = surfaces_.setAir(next); !s) return s;
  air_ = std::move(next);
  return Status::ok();
}

/// Veils are averaged. The Sun is taken by as many points.
Status GlScene::captureMirrors(const Surroundings& surroundings) {
  if (!hasMirrors()) return Status::ok();
  if (!mirrors_) {
    if (!GlMirrors::areIn(asset_->scene)) return Status::ok();
    Result<GlMirrors> made =
        GlMirrors::make(asset_->scene, std::min(options_.mirrorSide, options_.largestTexture));
    if (!made) return made.error();
    mirrors_.emplace(std::move(*made));
  }
  const bool showsEnvironment = mirrors_->showMirrors() || mirrors_->hasVeils();
  const bool turned =
      environmentStale_ || environmentInMirrors_ != surroundings.environmentFromWorld;
  if (!mirrorsStale_ && !(showsEnvironment && turned)) return Status::ok();
  const int samples = mirrors_->hasVeils() ? std::max(surroundings.veilSamples, 1) : 1;
  std::vector<light::SunPoint> sun;
  if (surroundings.sun) sun = light::pointsOf(*surroundings.sun, samples);
  GlView view;
  view.environmentFromWorld = surroundings.environmentFromWorld;
  mirrors_->forget();
  for (int round = 0; round < (mirrors_->showMirrors() ? 2 : 1); ++round)
    for (view.sample = 0; view.sample < samples; ++view.sample) {
      if (!sun.empty()) {
        view.sun = sun[std::size_t(view.sample)];
        if (Status s = mapSun(*view.sun, nullptr, view.sample); !s) return s;
      }
      mirrors_->draw(view, surroundings.environment,
                     [&](const GlView& face) { draw(face, surroundings.environment); });
    }
  mirrorsStale_ = environmentStale_ = false;
  environmentInMirrors_ = surroundings.environmentFromWorld;
  return checkGl("drawing what mirrors show");
}

Status GlScene::mapSun(const GlView& view) {
  if (!view.sun || view.unlit) return Status::ok();
  return mapSun(*view.sun, &view.clipFromWorld, view.sample);
}

Status GlScene::mapSun(const light::SunPoint& sun, const Mat4* clipFromWorld, int sample) {
  if (!sunMap_) {
    Result<GlSunMap> made = GlSunMap::make(options_.largestTexture);
    if (!made) return made.error();
    sunMap_.emplace(std::move(*made));
  }
  glBindVertexArray(noAttributes_.name());
  colors_.bindTable();
  sunMap_->draw(sun, clipFromWorld, bounds_, [&] {
    const auto drawPiece = [&](std::uint32_t mesh, GLuint vertices, GLuint corners, int count) {
      if (asset_->scene.meshes[mesh].layer) return;  // what it lies on hides as much
      const bool gaps = colors_.hasGaps(mesh);
      const Program& program = gaps ? sunMap_->gapsProgram() : sunMap_->wholeProgram();
      program.use();
      if (gaps) {
        colors_.bind(program, mesh);
        colors_.bindCoverage(program, mesh, sample);
      }
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, vertices);
      glVertexArrayElementBuffer(noAttributes_.name(), corners);
      glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
    };
    surfaces_.drawUnlit(drawPiece);
    patches_.drawUnlit(drawPiece);
  });
  return checkGl("drawing the Sun's shadows");
}

void GlScene::draw(const GlView& view, const GlEnvironment& environment) const {
  glFrontFace(view.mirrored ? GL_CW : GL_CCW);
  glBindVertexArray(noAttributes_.name());
  colors_.bindTable();
  if (view.unlit) {
    drawUnlit(view);
    return;
  }
  patches_.draw(view, colors_, noAttributes_.name());
  surfaces_.draw(view,
                 {environment, mirrors_ ? &*mirrors_ : nullptr, sunMap_ ? &*sunMap_ : nullptr},
                 colors_, options_.showing, noAttributes_.name());
}

void GlScene::drawUnlit(const GlView& view) const {
  unlit_.use();
  unlit_.setMatrix("clipFromWorld", view.clipFromWorld.data());
  const auto drawPiece = [&](std::uint32_t mesh, GLuint vertices, GLuint corners, int count) {
    const scene::Material& material = asset_->scene.materials[asset_->scene.meshes[mesh].material];
    const Rgb reflectance =
        material.isMirror() ? material.mirror : Rgb(material.diffuse + material.glossy);
    unlit_.set("reflectance", reflectance.x(), reflectance.y(), reflectance.z());
    unlit_.set("hasColor", int(!asset_->scene.meshes[mesh].colors.empty() && !isPatched(mesh)));
    colors_.bind(unlit_, mesh);
    colors_.bindCoverage(unlit_, mesh, view.sample);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, vertices);
    glVertexArrayElementBuffer(noAttributes_.name(), corners);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
  };
  patches_.drawUnlit(drawPiece);
  surfaces_.drawUnlit(drawPiece);
}

}  // namespace lambent::render
