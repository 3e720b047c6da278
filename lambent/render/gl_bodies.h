// The bodies of a moving scene on the GPU: their shapes, once.
#pragma once

#include <vector>

#include "lambent/capture/moving_scene.h"
#include "lambent/render/gl_objects.h"

namespace lambent::render {

class GlBodies {
 public:
  static Result<GlBodies> make(const capture::MovingScene& scene);

  struct Body {
    capture::Motion motion;
    Rgb radiance;
    Vec3 center;   ///< of its box, in its own frame
    float radius;  ///< of a sphere about `center` that holds it
    int indexCount;
    std::size_t firstIndex;
    int firstVertex;
  };
  const std::vector<Body>& all() const { return bodies_; }

  /// Positions become attribute 0 of what is drawn until another vertex array is bound.
  void bind() const { glBindVertexArray(array_.name()); }
  void draw(const Body& body, int instances) const;

 private:
  std::vector<Body> bodies_;
  Buffer positions_, indices_;
  VertexArray array_;
};

}  // namespace lambent::render
