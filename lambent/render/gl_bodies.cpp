#include "lambent/render/gl_bodies.h"

#include <cmath>

namespace lambent::render {

Result<GlBodies> GlBodies::make(const capture::MovingScene& scene) {
  GlBodies result;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  for (const capture::Body& body : scene.bodies) {
    if (body.mesh.triangles.empty()) continue;
    const scene::Box box = scene::bounds(body.mesh);
    float radius2 = 0;
    for (const Vec3& p : body.mesh.positions)
      radius2 = std::max(radius2, (p - box.center()).squaredNorm());
    result.bodies_.push_back({body.motion, body.radiance, box.center(), std::sqrt(radius2),
                              int(3 * body.mesh.triangles.size()), indices.size(),
                              int(positions.size())});
    positions.insert(positions.end(), body.mesh.positions.begin(), body.mesh.positions.end());
    for (const scene::Triangle& t : body.mesh.triangles)
      indices.insert(indices.end(), t.begin(), t.end());
  }
  result.positions_ = makeBuffer(positions);
  result.indices_ = makeBuffer(indices);
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  result.array_ = VertexArray(name);
  glVertexArrayVertexBuffer(name, 0, result.positions_.name(), 0, sizeof(Vec3));
  glVertexArrayElementBuffer(name, result.indices_.name());
  glEnableVertexArrayAttrib(name, 0);
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, 0, 0);
  if (Status s = checkGl("uploading lamps and occluders"); !s) return s.error();
  return result;
}

void GlBodies::draw(const Body& body, int instances) const {
  const auto* offset = reinterpret_cast<const void*>(body.firstIndex * sizeof(std::uint32_t));
  glDrawElementsInstancedBaseVertex(GL_TRIANGLES, body.indexCount, GL_UNSIGNED_INT, offset,
                                    instances, body.firstVertex);
}

}  // namespace lambent::render
