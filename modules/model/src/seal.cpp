#include "seal.h"

#include "cell_fields.h"
#include "fault_tears.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace graben {

namespace {

/// Which patch a triangle may belong to.
struct Parts {
  Index surface, behind, in_front;
  bool operator<(const Parts& o) const { return std::tie(surface, behind, in_front) < std::tie(o.surface, o.behind, o.in_front); }
  bool operator==(const Parts& o) const { return surface == o.surface && behind == o.behind && in_front == o.in_front; }
};

class Sealer {
public:
  Sealer(const LabelledCells& cells, const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options)
    : cells_(cells), horizons_(horizons), faults_(faults), o_(options) {}

  SealedMesh seal(std::vector<double>& beyond) {
    nameSurfaces();
    gatherFaces();
    joinPatches();
    compactVertices(beyond);
    describeBlocks();
    return std::move(sealed_);
  }

private:
  static constexpr Index kWalls = 6;

  void nameSurfaces() {
    const std::array<const char*, 4> walls = {"west", "east", "south", "north"};
    for (const char* name : walls)
      sealed_.surfaces.push_back({name, SealedSurfaceKind::Wall});
    sealed_.surfaces.push_back({o_.base_name, SealedSurfaceKind::Base});
    sealed_.surfaces.push_back({o_.top_name, SealedSurfaceKind::Top});
    for (const StackHorizon& h : horizons_)
      sealed_.surfaces.push_back({h.name, SealedSurfaceKind::Horizon});
    for (std::size_t f = 0; f < faults_.size(); ++f)
      sealed_.surfaces.push_back({faults_.fault(f).name, SealedSurfaceKind::Fault});
    if (!o_.outline.empty()) {
      outline_ = static_cast<Index>(sealed_.surfaces.size());
      sealed_.surfaces.push_back({"outline", SealedSurfaceKind::Wall});
    }
  }

  Index wallSurface(std::size_t cell, int face) const {
    const std::int16_t mark = cells_.mesh.marks[cell][static_cast<std::size_t>(face)];
    if (mark < -1)
      return mark == kTopMark ? 5 : mark == kBaseMark ? 4 : outline_;
    unsigned walls = ~0U;
    for (const int corner : kTetrahedronFaces[static_cast<std::size_t>(face)])
      walls &= wallsOf(cells_.mesh.position(cells_.mesh.cells[cell][static_cast<std::size_t>(corner)]), o_.box);
    for (Index w = 0; w < kWalls; ++w)
      if ((walls >> w & 1U) != 0)
        return w;
    return 0;
  }

  /// Horizons that run together, where the layers between them are absent, are a surface of their own.
  Index horizonSurface(Index upper_layer, Index lower_layer) {
    if (lower_layer == upper_layer + 1)
      return kWalls + upper_layer;
    const auto known = together_.find({upper_layer, lower_layer});
    if (known != together_.end())
      return known->second;
    std::string name;
    for (Index k = upper_layer; k < lower_layer; ++k)
      name += (name.empty() ? "" : "+") + horizons_[static_cast<std::size_t>(k)].name;
    sealed_.surfaces.push_back({name, SealedSurfaceKind::Horizon});
    return together_[{upper_layer, lower_layer}] = static_cast<Index>(sealed_.surfaces.size() - 1);
  }

  void add(std::size_t cell, int face, const Parts& parts) {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = cells_.mesh.cells[cell][static_cast<std::size_t>(kTetrahedronFaces[static_cast<std::size_t>(face)][i])];
    sealed_.triangles.push_back(t);
    parts_.push_back(parts);
  }

  void gatherFaces() {
    const CellNeighbors neighbors(cells_.mesh);
    const auto fault_surface = [this](std::int16_t mark) { return kWalls + static_cast<Index>(horizons_.size()) + faultOf(mark); };
    for (std::size_t c = 0; c < cells_.block.size(); ++c)
      for (int f = 0; f < 4; ++f) {
        const Index behind = neighbors.behind(c, f);
        const std::int16_t mark = cells_.mesh.marks[c][static_cast<std::size_t>(f)];
        if (behind < 0) {
          add(c, f, {wallSurface(c, f), cells_.block[c], -1});
          continue;
        }
        const auto other = static_cast<std::size_t>(behind / 4);
        if (mark >= 0) {
          if (!inHangingWall(mark))
            add(c, f, {fault_surface(mark), cells_.block[c], cells_.block[other]});
        } else if (cells_.layer[c] > cells_.layer[other]) {
          add(c, f, {horizonSurface(cells_.layer[other], cells_.layer[c]), cells_.block[c], cells_.block[other]});
        }
      }
  }

  void joinPatches() {
    struct Side {
      std::uint64_t edge;
      Index triangle;
    };
    const std::size_t count = sealed_.triangles.size();
    std::vector<Side> sides;
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t e = 0; e < 3; ++e)
        sides.push_back({EdgeMap::key(sealed_.triangles[t][e], sealed_.triangles[t][(e + 1) % 3]), static_cast<Index>(t)});
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle; });
    std::vector<Index> root(count);
    std::iota(root.begin(), root.end(), Index{0});
    const auto find = [&root](Index t) {
      while (root[static_cast<std::size_t>(t)] != t)
        t = root[static_cast<std::size_t>(t)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(t)])];
      return t;
    };
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t k = i + 1; k < sides.size() && sides[k].edge == sides[i].edge; ++k)
        if (parts_[static_cast<std::size_t>(sides[i].triangle)] == parts_[static_cast<std::size_t>(sides[k].triangle)]) {
          const Index a = find(sides[i].triangle), b = find(sides[k].triangle);
          root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    std::map<std::pair<Parts, Index>, Index> patch_of;
    for (std::size_t t = 0; t < count; ++t)
      patch_of.insert({{parts_[t], find(static_cast<Index>(t))}, 0});
    for (auto& [key, patch] : patch_of) {
      patch = static_cast<Index>(sealed_.patches.size());
      sealed_.patches.push_back({key.first.surface, key.first.behind, key.first.in_front});
    }
    std::vector<std::pair<Index, std::size_t>> order;
    for (std::size_t t = 0; t < count; ++t)
      order.emplace_back(patch_of.at({parts_[t], find(static_cast<Index>(t))}), t);
    std::sort(order.begin(), order.end());
    std::vector<Triangle> sorted;
    for (const auto& [patch, t] : order) {
      sorted.push_back(sealed_.triangles[t]);
      sealed_.triangle_patch.push_back(patch);
    }
    sealed_.triangles = std::move(sorted);
  }

  void compactVertices(std::vector<double>& beyond) {
    std::vector<Index> place(cells_.mesh.vertices.size(), -1);
    for (Triangle& t : sealed_.triangles)
      for (Index& v : t) {
        Index& to = place[static_cast<std::size_t>(v)];
        if (to < 0) {
          to = static_cast<Index>(sealed_.vertices.size());
          sealed_.vertices.push_back(cells_.mesh.vertices[static_cast<std::size_t>(v)]);
          beyond.push_back(cells_.beyond.empty() ? 0.0 : cells_.beyond[static_cast<std::size_t>(v)]);
        }
        v = to;
      }
  }

  std::string layerName(Index layer) const {
    if (layer == 0)
      return "above_" + horizons_.front().name;
    if (static_cast<std::size_t>(layer) == horizons_.size())
      return "below_" + horizons_.back().name;
    return horizons_[static_cast<std::size_t>(layer) - 1].name + "-" + horizons_[static_cast<std::size_t>(layer)].name;
  }

  void describeBlocks() {
    std::vector<SealedBlock>& blocks = sealed_.blocks;
    blocks.resize(static_cast<std::size_t>(cells_.blocks));
    std::vector<std::size_t> in_layer(horizons_.size() + 1, 0);
    for (SealedBlock& block : blocks)
      block.fault_side.assign(faults_.size(), 0);
    for (std::size_t c = 0; c < cells_.block.size(); ++c)
      blocks[static_cast<std::size_t>(cells_.block[c])].layer = cells_.layer[c];
    for (const SealedBlock& block : blocks)
      ++in_layer[static_cast<std::size_t>(block.layer)];
    const auto touch = [&](Index block, Index fault, int side) {
      int& known = blocks[static_cast<std::size_t>(block)].fault_side[static_cast<std::size_t>(fault)];
      known = known == 0 || known == side ? side : 2;
    };
    const auto first_fault = kWalls + static_cast<Index>(horizons_.size());
    for (const SealedPatch& patch : sealed_.patches) {
      if (sealed_.surfaces[static_cast<std::size_t>(patch.surface)].kind != SealedSurfaceKind::Fault)
        continue;
      touch(patch.behind, patch.surface - first_fault, -1);
      touch(patch.in_front, patch.surface - first_fault, 1);
    }
    std::set<std::string> taken;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const TriangleMesh surface = blockSurface(sealed_, static_cast<Index>(b));
      blocks[b].volume = enclosedVolume(surface.vertices, surface.triangles);
      for (const Triangle& t : surface.triangles) {
        const auto p = [&](std::size_t i) -> const Vector3& { return surface.vertices[static_cast<std::size_t>(t[i])]; };
        blocks[b].area += 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
      }
      std::string name = layerName(blocks[b].layer);
      for (std::size_t f = 0; f < faults_.size() && in_layer[static_cast<std::size_t>(blocks[b].layer)] > 1; ++f)
        if (std::abs(blocks[b].fault_side[f]) == 1)
          name += "_" + faults_.fault(f).name + (blocks[b].fault_side[f] > 0 ? "+" : "-");
      std::string unique = name;
      for (int i = 2; !taken.insert(unique).second; ++i)
        unique = name + "_" + std::to_string(i);
      blocks[b].name = unique;
    }
  }

  const LabelledCells& cells_;
  const std::vector<StackHorizon>& horizons_;
  const FaultNetwork& faults_;
  const BlockModelOptions& o_;
  SealedMesh sealed_;
  std::vector<Parts> parts_; ///< of each triangle
  Index outline_ = 0;        ///< the surface of walls that are no faces of the box
  std::map<std::pair<Index, Index>, Index> together_;
};

} // namespace

SealedMesh sealCells(const LabelledCells& cells, const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options,
                     std::vector<double>& beyond) {
  return Sealer(cells, horizons, faults, options).seal(beyond);
}

} // namespace graben
