// What mirrors show of the asset they belong to (shaders/local_capture.glsl): cube maps of all
// other surfaces as they are lit, each drawn from a place at one mirror. Nothing in them depends on
// the viewer.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lambent/render/gl_environment.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_view.h"
#include "lambent/scene/scene.h"

namespace lambent::render {

/// What programs of mirrors include.
std::string localCaptureSource();

class GlMirrors {
 public:
  /// Mirrors with a map of their own, the largest first. What the others show is looked up in the
  /// nearest of these.
  static constexpr std::size_t kMost = 8;

  /// For the mirrors of `scene`, which must outlive it. `side`: of a face, in texels; half as many,
  /// and so on, where memory does not suffice.
  static Result<GlMirrors> make(const scene::Scene& scene, int side);
  /// Whether there is a mirror, and anything for one to show.
  static bool areIn(const scene::Scene& scene);

  std::size_t count() const { return captures_.size(); }
  /// Maps show mirrors. These show the environment, unless maps are drawn a second time: then they
  /// show the first.
  bool showMirrors() const { return showMirrors_; }
  bool hasVeils() const { return veils_; }

  /// Until they are drawn anew, mirrors show the environment alone.
  void forget();
  /// Draws sub-sample number view.sample of all maps, calling drawFace(view) for every face. Of
  /// `view` the Sun, the environment's frame and that number are taken. Leaves another framebuffer,
  /// viewport and program than before.
  template <class DrawFace>
  void draw(const GlView& view, const GlEnvironment& environment, DrawFace drawFace) {
    for (Capture& capture : captures_) {
      for (int face = 0; face < 6; ++face) {
        const GlView seen = viewOf(capture, face, view);
        beginFace();
        drawFace(seen);
        endFace(capture, face, seen, environment);
      }
      capture.drawn = true;
    }
  }
  /// For the program of a mirror that draws a mesh next, in a frame that is sub-sample number
  /// `sample`.
  void bind(const Program& program, std::uint32_t mesh, int sample) const;
  /// The same without any map.
  static void bindNone(const Program& program);

 private:
  struct Capture {
    std::uint32_t mesh = 0;
    Vec3 from;  ///< in the asset's frame
    float near = 0, far = 0;
    Texture map;  ///< a cube
    bool drawn = false;
  };
  Status makeMaps(int side);
  Status makeProgram();
  GlView viewOf(const Capture& capture, int face, const GlView& view) const;
  void beginFace() const;
  void endFace(const Capture& capture, int face, const GlView& view,
               const GlEnvironment& environment) const;

  std::vector<Capture> captures_;
  std::map<std::uint32_t, std::size_t> captureOf_;  ///< by mesh
  bool showMirrors_ = false, veils_ = false;
  int side_ = 0;
  GLenum format_ = GL_RGBA16F;
  Texture color_, depth_;
  Framebuffer framebuffer_;
  Program keep_;
};

}  // namespace lambent::render
