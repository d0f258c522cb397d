#include "graben/mesh/normals.h"

#include "triangles/corner_angles.h"

#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// The corners at some vertices, and what the triangles there say of the normals.
class NormalSums {
public:
  /// Sets the normals of the vertices of_number(begin), ..., of_number(end - 1).
  template <typename OfNumber>
  void set(TriangleMesh& mesh, const VertexCorners& corners, std::size_t begin, std::size_t end, const OfNumber& of_number) {
    constexpr std::size_t at_once = 64; // what is known of them stays in cache
    for (; begin < end; begin += at_once) {
      const std::size_t last = std::min(begin + at_once, end);
      count_ = 0;
      for (std::size_t i = begin; i < last; ++i)
        for (const Index corner : corners.of(of_number(i)))
          add(mesh, static_cast<std::size_t>(corner));
      makeRoomFor(count_ + detail::kCornerLanes);
      detail::anglesPerSine({sine_.data(), cosine_.data(), count_}, weight_.data());
      std::size_t c = 0;
      for (std::size_t i = begin; i < last; ++i) {
        const VertexCorners::Range of_vertex = corners.of(of_number(i));
        Vector3 sum = Vector3::Zero();
        for (const std::size_t next = c + static_cast<std::size_t>(of_vertex.last - of_vertex.first); c < next; ++c)
          if (weight_[c] > 0.0)
            sum += weight_[c] * normal_[c];
        const double length = sum.norm();
        mesh.normals[of_number(i)] = length > 1e-12 ? Vector3(sum / length) : Vector3(Vector3::UnitZ());
      }
    }
  }

private:
  void makeRoomFor(std::size_t count) {
    if (count <= normal_.size())
      return;
    count *= 2;
    for (std::vector<double>* values : {&sine_, &cosine_, &weight_})
      values->resize(count);
    normal_.resize(count);
  }

  void add(const TriangleMesh& mesh, std::size_t corner) {
    makeRoomFor(count_ + 1);
    const Triangle& t = mesh.triangles[corner / 3];
    const std::size_t e = corner % 3;
    const Vector3& at = mesh.vertices[static_cast<std::size_t>(t[e])];
    const Vector3 u = mesh.vertices[static_cast<std::size_t>(t[(e + 1) % 3])] - at;
    const Vector3 w = mesh.vertices[static_cast<std::size_t>(t[(e + 2) % 3])] - at;
    normal_[count_] = u.cross(w);
    sine_[count_] = normal_[count_].norm();
    cosine_[count_] = u.dot(w);
    ++count_;
  }

  std::size_t count_ = 0;
  std::vector<double> sine_, cosine_, weight_; ///< of each corner; times and over the lengths of its two sides
  Points normal_;
};

} // namespace

Vector3 areaNormal(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vector3& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const Vector3& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
  const Vector3& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
  return (b - a).cross(c - a);
}

void computeVertexNormals(TriangleMesh& mesh, unsigned threads) {
  computeVertexNormals(mesh, VertexCorners(mesh, threads), threads);
}

void computeVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, unsigned threads) {
  mesh.normals.resize(mesh.vertices.size());
  parallelBlocks(mesh.vertices.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    NormalSums().set(mesh, corners, begin, end, [](std::size_t v) { return v; });
  });
}

void updateVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& vertices, unsigned threads) {
  parallelBlocks(vertices.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    NormalSums().set(mesh, corners, begin, end, [&](std::size_t i) { return static_cast<std::size_t>(vertices[i]); });
  });
}

} // namespace graben
