#include "apps/lambent/scene_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/lambent/arguments.h"
#include "lambent/asset/asset.h"
#include "lambent/scene/shapes.h"

namespace lambent::tool {

namespace {

/// One material's reflectance moves to the kind that was asked for.
void overrideMaterial(const SceneArguments& arguments, scene::Material& material) {
  const Rgb own = material.isMirror() ? material.mirror
                  : material.isGlossy() && !material.isDiffuse()
                      ? material.glossy
                      : Rgb(material.diffuse + material.transmitted);
  const Rgb reflectance = arguments.albedo.value_or(own);
  std::optional<MaterialKind> kind = arguments.material;
  if (!kind && arguments.albedo)
    kind = material.isMirror()                            ? MaterialKind::Mirror
           : material.isGlossy() && !material.isDiffuse() ? MaterialKind::Glossy
                                                          : MaterialKind::Diffuse;
  if (kind) {
    material.diffuse = material.glossy = material.mirror = material.transmitted = Rgb::Zero();
    (kind == MaterialKind::Mirror   ? material.mirror
     : kind == MaterialKind::Glossy ? material.glossy
                                    : material.diffuse) = reflectance;
  }
  if (arguments.lobeExponent) material.lobeExponent = float(*arguments.lobeExponent);
}

/// A grey square under the scene, 1.6 times as wide, of 160 × 160 quads so that it can hold
/// shadows.
void addGround(scene::Scene& scene) {
  const scene::Box box = scene::bounds(scene);
  const Vec3 extent = box.upper - box.lower;
  const float side = 1.6f * std::max(extent.x(), extent.z());
  scene::Mesh ground = scene::gridPlane(side, side, 160, 160);
  ground.name = "ground";
  scene::Material grey;
  grey.name = "ground";
  grey.diffuse = Rgb::Constant(0.5f);
  const Vec3 below(box.center().x(), box.lower.y(), box.center().z());
  scene::addTo(scene, scene::translated(std::move(ground), below), grey);
}

}  // namespace

void SceneArguments::addTo(CLI::App& app) {
  app.add_option("SCENE", path, "The scene: .glb, .gltf, .obj or .ply; - : standard input")
      ->required();
  addChoice(app, "--material", material,
            {{"diffuse", MaterialKind::Diffuse},
             {"glossy", MaterialKind::Glossy},
             {"mirror", MaterialKind::Mirror}},
            "Make every surface diffuse, glossy or mirror, whatever the file says")
      ->option_text("KIND")
      ->group("Material");
  addParsed(app, "--albedo", albedo, parseReflectance,
            "Reflectance of every surface, linear, 0 to 1 per channel. Textures still multiply it")
      ->option_text("R,G,B")
      ->group("Material");
  addNumber(app, "--lobe", lobeExponent, kLobeExponents,
            "Exponent of every glossy lobe: 4 is satin, 64 is polished")
      ->option_text("EXPONENT")
      ->group("Material");
  app.add_flag("--ground", ground,
               "Put the scene on a grey floor, 1.6 times as wide, that takes shadows and light")
      ->group("Material");
  addNumber(app, "--smooth", smooth, {0.0, 180.0},
            "Where a file gives no normals, make them smooth across edges that bend by less, in "
            "degrees (default: 0 for glTF, whose facets are flat, 180 for OBJ and PLY)")
      ->option_text("DEGREES")
      ->group("Reading");
  reading.addTo(app);
}

void SceneArguments::addSidesTo(CLI::App& app) {
  using scene_io::Sides;
  addChoice(app, "--sides", sides,
            {{"file", Sides::AsFileSays}, {"one", Sides::One}, {"two", Sides::Two}},
            "file, one or two. What is lit and seen from behind as well: what the file calls "
            "double-sided, unless it bounds a body; nothing (one); everything (two), as leaves and "
            "cloth of OBJ and PLY need it, or a room seen from within. Two sides are twice the "
            "vertices")
      ->option_text("KIND")
      ->group("Reading");
}

Result<scene::Scene> SceneArguments::load(Console& console, NamedFiles& files) const {
  scene::Scene scene;
  bool baked = false;
  if (extensionOf(path) == ".glb") {
    const Result<bool> isAsset = asset::isAsset(path);
    baked = isAsset && *isAsset;  // what cannot be read is the loader's to explain
  }
  if (baked) {
    files.readsLinksOf("SCENE", path);
    if (Status distinct = files.check(); !distinct) return distinct.error();
    auto asset = console.stage("load", [&] { return asset::read(path, reading.forAsset()); });
    if (!asset) return asset.error();
    scene = std::move(asset->scene);
  } else {
    scene_io::LoadOptions options = reading.forScene();
    options.layout = layout;
    options.sides = sides;
    if (smooth) options.crease = float(*smooth * kPi / 180.0);
    auto loaded = console.stage("load", [&] { return scene_io::load(path, options); });
    if (!loaded) return loaded.error();
    if (Status whole = console.accept(loaded->findings); !whole) return whole.error();
    scene = std::move(loaded->scene);
    files.readsFilesOf("SCENE", loaded->linkedFiles);
    if (Status distinct = files.check(); !distinct) return distinct.error();
  }
  for (scene::Material& each : scene.materials) overrideMaterial(*this, each);
  if (ground) addGround(scene);
  return scene;
}

Result<scene::Scene> SceneArguments::loadToBake(Console& console, NamedFiles& files) const {
  auto scene = load(console, files);
  if (!scene) return scene;
  const std::size_t layers =
      std::erase_if(scene->meshes, [](const scene::Mesh& mesh) { return mesh.layer; });
  if (layers > 0)
    console.report(
        {{Severity::Note, "layers-left-out",
          fmt::format("{} layers of patches lie on other meshes, which are taken alone", layers),
          layers}});
  return scene;
}

}  // namespace lambent::tool
