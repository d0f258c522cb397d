#pragma once

#include "cut_state.h"

#include "graben/mesh/vertex_corners.h"

#include <array>
#include <vector>

namespace graben {

/// Sorts the triangles around a vertex into fans: neighbours are joined over the edges that just two of them have, in opposite directions, and that are
/// not cut. Triangles that name a vertex twice stay alone.
class Fans {
public:
  /// Both are kept by reference. \param[in] cuts null: no edge is cut
  explicit Fans(const CutMesh& cut, const CutState* cuts = nullptr) : cut_(cut), cuts_(cuts) {}

  /// \return the number of fans around the vertex
  std::size_t find(Index vertex, VertexCorners::Range corners);

  /// Calls act(corner, fan) for all corners of the vertex looked at last, if there is more than one fan; they are numbered by their first corners.
  template <typename Act>
  void visit(const Act& act) const {
    for (const Spoke& s : spokes_)
      act(s.corner, s.fan);
  }

private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A triangle as the vertex sees it.
  struct Spoke {
    Index corner;
    Index after, before; ///< the next vertex of the triangle, and the one before
    bool proper;
    std::size_t next = kNone, previous = kNone; ///< the triangles it is joined to
    std::size_t fan = kNone;
  };

  std::array<Index, 2> beside(Index corner) const;
  bool isRing(Index vertex, VertexCorners::Range corners) const;
  void list(Index vertex, VertexCorners::Range corners);
  void join(Index vertex);
  std::size_t number();

  const CutMesh& cut_;
  const CutState* cuts_;
  std::vector<Spoke> spokes_;
};

} // namespace graben
