#include "graben/mesh/triangle_mesh.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <utility>

namespace graben {

namespace {

/// Keeps the entries of \a values whose place in \a target is not -1; \a target never moves an
/// entry up.
template <typename T>
void compact(std::vector<T>& values, const std::vector<Index>& target, std::size_t kept) {
  if (values.empty())
    return;
  for (std::size_t i = 0; i < target.size(); ++i)
    if (target[i] >= 0)
      values[static_cast<std::size_t>(target[i])] = values[i];
  values.resize(kept);
}

template <typename T>
void appendArray(std::vector<T>& values, const std::vector<T>& other, bool target_empty) {
  if (!target_empty && (values.empty() || other.empty()))
    values.clear();
  else
    values.insert(values.end(), other.begin(), other.end());
}

/// The first of [0, count) for which \a bad holds; count if there is none.
template <typename Bad>
std::size_t firstOf(std::size_t count, unsigned threads, const Bad& bad) {
  constexpr std::size_t kGrain = 1 << 15;
  std::vector<std::size_t> found((count + kGrain - 1) / kGrain, count);
  parallelBlocks(count, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (bad(i)) {
        found[begin / kGrain] = i;
        return;
      }
  });
  return found.empty() ? count : *std::min_element(found.begin(), found.end());
}

void checkLength(std::size_t length, std::size_t vertices, const std::string& stage,
                 const std::string& name) {
  if (length != 0 && length != vertices)
    throw InvalidInputError(stage, "the mesh has " + std::to_string(vertices) + " vertices but " +
                                       std::to_string(length) + " entries of " + name);
}

} // namespace

std::vector<Index> removeUnreferencedVertices(TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t grain = 1 << 14;
  std::vector<std::atomic<std::uint8_t>> used(mesh.vertices.size());
  parallelFor(mesh.triangles.size(), grain, threads, [&](std::size_t t) {
    for (const Index v : mesh.triangles[t])
      used[static_cast<std::size_t>(v)].store(1, std::memory_order_relaxed);
  });
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  if (count == mesh.vertices.size())
    return {};
  std::vector<Index> target(mesh.vertices.size(), -1);
  Index kept = 0;
  for (std::size_t v = 0; v < target.size(); ++v)
    if (used[v] != 0)
      target[v] = kept++;
  compact(mesh.vertices, target, count);
  compact(mesh.normals, target, count);
  compact(mesh.piece, target, count);
  for (auto& scalar : mesh.scalars)
    compact(scalar.second, target, count);
  parallelFor(mesh.triangles.size(), grain, threads, [&](std::size_t t) {
    for (Index& v : mesh.triangles[t])
      v = target[static_cast<std::size_t>(v)];
  });
  return target;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  if (&mesh == &other) {
    append(mesh, TriangleMesh(other));
    return;
  }
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<Index>::max());
  if (other.vertices.size() > limit - mesh.vertices.size())
    throw InvalidInputError("joining meshes",
                            "the joined mesh has more vertices than 32-bit indices reach");
  const auto offset = static_cast<Index>(mesh.vertices.size());
  const bool target_empty = mesh.vertices.empty();
  if (target_empty)
    mesh.scalars = other.scalars;
  else
    for (auto it = mesh.scalars.begin(); it != mesh.scalars.end();) {
      const auto theirs = other.scalars.find(it->first);
      if (!other.vertices.empty() && (theirs == other.scalars.end() || theirs->second.empty())) {
        it = mesh.scalars.erase(it);
        continue;
      }
      if (theirs != other.scalars.end())
        it->second.insert(it->second.end(), theirs->second.begin(), theirs->second.end());
      ++it;
    }
  if (!other.vertices.empty()) {
    appendArray(mesh.normals, other.normals, target_empty);
    appendArray(mesh.piece, other.piece, target_empty);
  }
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  mesh.triangles.reserve(mesh.triangles.size() + other.triangles.size());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

void flipOrientation(TriangleMesh& mesh) {
  for (Triangle& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  for (Vector3& normal : mesh.normals)
    normal = -normal;
}

void validate(const TriangleMesh& mesh, const std::string& stage, unsigned threads) {
  const std::size_t count = mesh.vertices.size();
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()) ||
      mesh.triangles.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max() / 3))
    throw InvalidInputError(stage, "the mesh is larger than 32-bit indices reach");
  const std::size_t vertex = firstOf(count, threads, [&](std::size_t i) { return !mesh.vertices[i].allFinite(); });
  if (vertex < count)
    throw InvalidInputError(stage, "vertex " + std::to_string(vertex) + " of the mesh has a coordinate that is not finite");
  const auto missing = [count](Index v) { return v < 0 || static_cast<std::size_t>(v) >= count; };
  const std::size_t triangle = firstOf(mesh.triangles.size(), threads, [&](std::size_t t) {
    return missing(mesh.triangles[t][0]) || missing(mesh.triangles[t][1]) || missing(mesh.triangles[t][2]);
  });
  if (triangle < mesh.triangles.size()) {
    const Triangle& t = mesh.triangles[triangle];
    throw InvalidInputError(stage, "triangle " + std::to_string(triangle) + " names vertex " +
                                     std::to_string(*std::find_if(t.begin(), t.end(), missing)) + ", but the mesh has " +
                                     std::to_string(count) + " vertices");
  }
  checkLength(mesh.normals.size(), count, stage, "normals");
  checkLength(mesh.piece.size(), count, stage, "piece");
  for (const auto& scalar : mesh.scalars)
    checkLength(scalar.second.size(), count, stage, "the field " + scalar.first);
}

} // namespace graben
