#include "lambent/scene_io/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/winding.h"

namespace lambent::scene_io {
namespace {

using scene::Mesh;
using scene::Triangle;

bool isDegenerate(const Mesh& mesh, const Triangle& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  const Vec3d a = mesh.positions[t[0]].cast<double>(), b = mesh.positions[t[1]].cast<double>(),
              c = mesh.positions[t[2]].cast<double>();
  const Vec3d ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return !(ab.cross(ac).norm() > 1e-6 * longest);
}

/// Numbers groups from 0 where they are few among many: what is made for each number would be made
/// for each part of a file of many parts.
void renumber(std::vector<std::uint32_t>& groups) {
  const auto most = std::max_element(groups.begin(), groups.end());
  if (most == groups.end() || *most < 4 * groups.size()) return;
  std::unordered_map<std::uint32_t, std::uint32_t> newFromOld;
  for (std::uint32_t& group : groups) {
    group = newFromOld.try_emplace(group, std::uint32_t(newFromOld.size())).first->second;
  }
}

bool isUsable(const Vec3& n) {
  const float length = n.norm();
  return std::isfinite(length) && length > 1e-12f;
}

void reverseWinding(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

double signedVolume(const Mesh& mesh) {
  const Vec3d origin = mesh.positions[0].cast<double>();
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.positions[t[0]].cast<double>() - origin;
    const Vec3d b = mesh.positions[t[1]].cast<double>() - origin;
    const Vec3d c = mesh.positions[t[2]].cast<double>() - origin;
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

/// Of every vertex, how well its normal agrees with the triangles around it: the mean of the cosine
/// between them, weighted by area, in [−1, 1].
std::vector<float> agreement(const Mesh& mesh, const std::vector<Vec3>& normals) {
  std::vector<float> sums(normals.size(), 0.0f), areas(normals.size(), 0.0f);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 cross = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
    const float area = cross.norm();
    for (std::uint32_t v : t) {
      sums[v] += cross.dot(normals[v]);
      areas[v] += area;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (areas[i] > 0.0f) sums[i] /= areas[i];
  }
  return sums;
}

/// Below this a normal stands on the wrong side. Not 0: where two sides of a sheet share their
/// vertices the mean cancels, and its sign is noise.
constexpr float kOpposite = -0.01f;

std::size_t countOpposite(const std::vector<float>& agreements) {
  return std::size_t(
      std::count_if(agreements.begin(), agreements.end(), [](float a) { return a < kOpposite; }));
}

void addNoSide(std::size_t without, const std::string& place, Diagnosis& diagnosis) {
  if (without == 0) return;
  diagnosis.add(Severity::Warning, "no-side", without,
                "vertices have no triangle with a clear side; their made normal is +Y", place);
}

void makeNormals(Mesh& mesh, std::span<const std::uint32_t> groups, const std::string& place,
                 Diagnosis& diagnosis) {
  addNoSide(scene::computeNormals(mesh, groups), place, diagnosis);
}

void makeCreasedNormals(Mesh& mesh, float crease, const std::string& place, Diagnosis& diagnosis) {
  const std::size_t count = mesh.positions.size();
  addNoSide(scene::creaseNormals(mesh, crease), place, diagnosis);
  diagnosis.add(Severity::Note, "normals-made", count,
                crease > 0.0f ? "vertices had no normals; they were made, smooth where the surface "
                                "bends by less than --smooth says"
                              : "vertices had no normals; flat ones were made, as glTF demands: "
                                "--smooth DEGREES rounds edges that bend by less",
                place);
}

void addReversed(std::size_t triangles, const std::string& place, Diagnosis& diagnosis) {
  diagnosis.add(Severity::Warning, "winding-reversed", triangles,
                "triangles were wound against their normals; their winding was reversed, so that "
                "what was their back is lit now",
                place);
}

void finishNormals(Mesh& mesh, const FinishOptions& options, std::span<const std::uint32_t> groups,
                   const std::string& place, Diagnosis& diagnosis) {
  const std::size_t count = mesh.positions.size();
  if (mesh.normals.size() != count) {
    if (const std::size_t mixed = scene::reverseAgainstNeighbours(mesh); mixed > 0)
      diagnosis.add(
          Severity::Warning, "winding-mixed", mixed,
          "triangles were wound against their neighbours; their winding was reversed, so "
          "that each part faces one way: as most of it did or, of a closed part, outwards",
          place);
  }
  if (mesh.normals.size() != count && options.crease) {
    makeCreasedNormals(mesh, *options.crease, place, diagnosis);
    return;
  }
  if (mesh.normals.size() != count) {
    makeNormals(mesh, groups, place, diagnosis);
    diagnosis.add(Severity::Note, "normals-made", count,
                  "vertices had no normals; angle-weighted ones were made", place);
    return;
  }
  std::vector<Vec3> own = std::move(mesh.normals);
  std::size_t useless = 0;
  for (Vec3& n : own) {
    if (!isUsable(n)) {
      n = Vec3::Zero();
      ++useless;
      continue;
    }
    // A unit normal stays as it is, to the bit, so that what Lambent wrote is what it reads.
    const float squared = n.squaredNorm();
    if (std::abs(squared - 1.0f) > 1e-6f) n = n.stableNormalized();
  }
  mesh.normals = std::move(own);
  const std::size_t against = scene::reverseAgainstNormals(
      mesh,
      options.front == Front::Normals ? scene::LonePart::Normals : scene::LonePart::OutwardOnly);
  own = std::move(mesh.normals);
  if (against > 0) addReversed(against, place, diagnosis);
  std::vector<float> agreements = agreement(mesh, own);
  std::size_t opposite = countOpposite(agreements);
  const bool nearlyAll = opposite > 0 && double(opposite) >= 0.95 * double(count - useless);
  if (nearlyAll && (options.front == Front::Normals ||
                    (signedVolume(mesh) < 0.0 && scene::topology(mesh).insideOut()))) {
    reverseWinding(mesh);
    for (float& a : agreements) a = -a;
    opposite = countOpposite(agreements);
    addReversed(mesh.triangles.size(), place, diagnosis);
  }
  if (opposite > 0) {
    for (std::size_t i = 0; i < count; ++i) {
      if (agreements[i] < kOpposite) own[i] = -own[i];
    }
    diagnosis.add(Severity::Warning, "normals-flipped", opposite,
                  "normals pointed to the back of their triangles and were flipped to the front",
                  place);
    dropTangents(mesh, place, diagnosis);
  }
  if (useless > 0) {
    makeNormals(mesh, groups, place, diagnosis);
    for (std::size_t i = 0; i < count; ++i) {
      if (own[i].isZero(0.0f)) own[i] = mesh.normals[i];
    }
    diagnosis.add(Severity::Warning, "zero-normals", useless,
                  "normals were zero or not finite; angle-weighted ones were made in their place",
                  place);
    dropTangents(mesh, place, diagnosis);
  }
  mesh.normals = std::move(own);
}

void finishAttributes(Mesh& mesh, const std::string& place, Diagnosis& diagnosis) {
  std::size_t badUvs = 0, badColors = 0;
  for (Vec2& uv : mesh.uvs) {
    if (!uv.allFinite()) uv = Vec2::Zero(), ++badUvs;
  }
  for (Rgb& color : mesh.colors) {
    const bool finite = color.isFinite().all();
    if (!finite || color.minCoeff() < 0.0f || color.maxCoeff() > 1.0f) ++badColors;
    color = finite ? Rgb(color.max(0.0f).min(1.0f)) : Rgb(Rgb::Ones());
  }
  for (float& alpha : mesh.alphas) alpha = alpha < 1.0f ? std::max(alpha, 0.0f) : 1.0f;
  if (badUvs > 0) {
    diagnosis.add(Severity::Warning, "uvs-not-finite", badUvs,
                  "texture coordinates were not finite and are (0, 0) now", place);
  }
  if (badColors > 0) {
    diagnosis.lose(Severity::Warning, "colors-clamped", badColors,
                   "vertex colours were outside 0 to 1 and were clamped: what they say beyond is "
                   "lost. Write reflectances, which lie between 0 and 1",
                   place);
  }
}

}  // namespace

void Diagnosis::add(Severity severity, const std::string& code, std::uint64_t count,
                    const std::string& what, const std::string& place) {
  const auto [entry, isNew] = entries_.try_emplace(code, Entry{severity, count, what, place});
  if (!isNew) entry->second.count += count;
}

void Diagnosis::lose(Severity severity, const std::string& code, std::uint64_t count,
                     const std::string& what, const std::string& place) {
  add(severity, code, count, what, place);
  entries_.at(code).loss = true;
}

Findings Diagnosis::findings() const {
  Findings findings;
  for (const auto& [code, entry] : entries_) {
    std::string message = entry.count > 0 ? std::to_string(entry.count) + " " : std::string();
    message += entry.what;
    if (!entry.place.empty()) message += " (first: " + entry.place + ")";
    findings.push_back({entry.severity, code, std::move(message), entry.count, entry.loss});
  }
  return findings;
}

void dropTangents(Mesh& mesh, const std::string& place, Diagnosis& diagnosis) {
  const auto gone = std::erase_if(
      mesh.others, [](const scene::VertexNumbers& numbers) { return numbers.areTangents(); });
  if (gone > 0)
    diagnosis.lose(Severity::Note, "tangents-dropped", 1,
                   "meshes have tangents for normals that are no longer theirs, which were left "
                   "out: other viewers make tangents of their own for normal maps; export the mesh "
                   "as it is posed, with normals, to keep them",
                   place);
}

Status finishMesh(Mesh& mesh, const FinishOptions& options, const std::string& file,
                  const std::string& place, Diagnosis& diagnosis, bool* kept) {
  if (kept != nullptr) *kept = true;
  const std::size_t triangles = mesh.triangles.size();
  const auto badVertex = [&](std::size_t vertex, const char* what) {
    return report::badInput(file + ": " + place + ": vertex " + std::to_string(vertex) + what);
  };
  const auto checkPosition = [&](std::size_t vertex) -> Status {
    const Vec3& p = mesh.positions[vertex];
    if (!p.allFinite()) {
      return badVertex(vertex,
                       " has a position that is not a finite number; repair the mesh in a "
                       "modelling program");
    }
    // Beyond this the squares that normals and areas need leave the range of float.
    if (p.cwiseAbs().maxCoeff() > 1e9f) {
      return badVertex(vertex, " lies more than 10⁹ m from the origin; scale the mesh down");
    }
    return Status::ok();
  };
  // Of scans with a hole, unused vertices are often NaN: they matter only if they stay.
  if (options.keepAllVertices) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      if (Status status = checkPosition(v); !status) return status;
    }
  } else {
    for (const Triangle& t : mesh.triangles) {
      for (std::uint32_t v : t) {
        if (Status status = checkPosition(v); !status) return status;
      }
    }
  }
  std::vector<std::uint32_t> oldFromNew;
  if (!options.keepAllVertices) {
    std::size_t first = triangles;
    for (std::size_t i = 0; i < triangles && first == triangles; ++i) {
      if (isDegenerate(mesh, mesh.triangles[i])) first = i;
    }
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return isDegenerate(mesh, t); });
    if (const std::size_t gone = triangles - mesh.triangles.size(); gone > 0) {
      diagnosis.add(Severity::Warning, "degenerate-triangles", gone,
                    "degenerate triangles (without area) were kept out",
                    place + ", triangle " + std::to_string(first));
      if (kept != nullptr) *kept = false;
    }
    const std::size_t vertices = mesh.positions.size();
    oldFromNew = scene::dropUnusedVertices(mesh);
    if (const std::size_t gone = vertices - mesh.positions.size(); gone > 0) {
      diagnosis.add(Severity::Note, "unused-vertices", gone,
                    "vertices belong to no triangle and were dropped", place);
      if (kept != nullptr) *kept = false;
    }
  }
  if (mesh.triangles.empty()) return Status::ok();

  std::vector<std::uint32_t> groups;
  if (!options.groups.empty()) {
    groups.assign(options.groups.begin(), options.groups.end());
    for (std::size_t i = 0; i < oldFromNew.size(); ++i) groups[i] = groups[oldFromNew[i]];
    if (!options.keepAllVertices) groups.resize(oldFromNew.size());
    renumber(groups);
  }
  // Without normals tangents mean nothing, says glTF.
  if (mesh.normals.empty())
    std::erase_if(mesh.others,
                  [](const scene::VertexNumbers& numbers) { return numbers.areTangents(); });
  const std::size_t unsplit = mesh.positions.size();
  finishNormals(mesh, options, groups, place, diagnosis);
  if (kept != nullptr && mesh.positions.size() != unsplit) *kept = false;
  finishAttributes(mesh, place, diagnosis);
  if (signedVolume(mesh) < 0.0 && scene::topology(mesh).insideOut()) {
    diagnosis.add(Severity::Warning, "inside-out", 1,
                  "closed meshes have their fronts inside: seen from outside they will be black; "
                  "right for a room seen from within, otherwise flip the normals in a modelling "
                  "program",
                  place);
  }
  return Status::ok();
}

}  // namespace lambent::scene_io
