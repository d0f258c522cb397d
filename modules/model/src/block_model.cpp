#include "graben/model/block_model.h"

#include "coarsen.h"
#include "fault_tears.h"
#include "horizon_heights.h"
#include "labelled_cells.h"
#include "outline.h"
#include "seal.h"
#include "stack.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/graded_box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kWarp = 0.3;
constexpr double kSnap = 0.08;
constexpr double kClose = 0.1; // sizes

class BlockModelJob {
public:
  BlockModelJob(const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options)
    : horizons_(horizons), faults_(faults), o_(options) {}

  BlockModel run() {
    check();
    model_.horizons.resize(horizons_.size());
    report(o_.progress, "filling the box", 0.0);
    fillBox();
    report(o_.progress, "cutting along faults", 0.0);
    cutAlongFaults(mesh_, faults_, {o_.box, o_.size, o_.threads});
    cutToOutline(mesh_, o_);
    const Points inside = tearOpen(mesh_);
    report(o_.progress, "horizons", 0.0);
    stack(inside);
    cutAlongHorizons();
    report(o_.progress, "blocks", 0.0);
    label();
    {
      const CellNeighbors neighbors(cells_.mesh, o_.threads);
      nameBlocks(neighbors);
      report(o_.progress, "shaping triangles", 0.0);
      coarsen(cells_, neighbors, {o_.box, o_.size});
    }
    std::vector<double> beyond;
    model_.sealed = sealCells(cells_, horizonsInside(), faults_, o_, beyond);
    reportHorizons(beyond);
    return std::move(model_);
  }

private:
  void check() const {
    if (horizons_.empty())
      throw InvalidInputError("model", "there is no horizon");
    if (!(o_.size > 0.0) || !std::isfinite(o_.size) || !(o_.min_thickness >= 0.0) || !(o_.fill >= 0.0))
      throw InvalidInputError("model", "the size must be positive, the least thickness and the fill not negative");
    if (faults_.size() > 16000 || o_.outline.size() > 16000)
      throw InvalidInputError("model", "more than 16000 faults, or corners of its outline");
    for (const Eigen::Vector2d& corner : o_.outline)
      if (!corner.allFinite() || o_.outline.size() < 3)
        throw InvalidInputError("outline", "a polygon has three corners at least, with finite coordinates");
  }

  void fillBox() {
    TriangleMesh surfaces;
    for (const StackHorizon& h : horizons_)
      appendSurface(surfaces, h.mesh);
    for (std::size_t f = 0; f < faults_.size(); ++f)
      appendSurface(surfaces, faults_.fault(f).mesh);
    appendSurface(surfaces, outlineWalls(o_));
    const TriangleBvh bvh(surfaces, o_.threads);
    GradedBoxOptions box;
    box.box = o_.box;
    box.size = o_.size;
    box.coarsest = o_.wall_size;
    box.threads = o_.threads;
    box.wanted = [&bvh](const std::array<Vector3, 4>& corners) { return bvh.mayPart(corners.data(), corners.size()); };
    mesh_ = gradedBox(box);
  }

  static void appendSurface(TriangleMesh& all, const TriangleMesh& mesh) {
    TriangleMesh bare;
    bare.vertices = mesh.vertices;
    bare.triangles = mesh.triangles;
    append(all, bare);
  }

  void stack(const Points& inside) {
    const NodeGraph graph(mesh_, o_.threads);
    std::vector<HorizonHeights> heights(horizons_.size());
    std::vector<std::string> errors(horizons_.size());
    const auto find = [&](std::size_t k) {
      try {
        heights[k] = horizonHeights(mesh_, inside, graph, horizons_[k].mesh, faults_, {kClose * o_.size, o_.threads});
      } catch (const InvalidInputError& error) {
        errors[k] = error.what();
      }
    };
    const bool one_by_one = horizons_.size() < threadCount(o_.threads);
    parallelFor(horizons_.size(), 1, one_by_one ? 1 : o_.threads, find);
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (!errors[k].empty())
        throw InvalidInputError("horizon " + horizons_[k].name, errors[k]);
    stack_ = stackHorizons(mesh_, graph, horizons_, std::move(heights), o_, model_);
  }

  void cutAlongHorizons() {
    const std::size_t count = horizons_.size();
    above_.resize(count);
    beyond_.resize(count);
    for (std::size_t k = 0; k < count; ++k)
      beyond_[k].assign(stack_.beyond[k].begin(), stack_.beyond[k].end());
    for (std::size_t k = 0; k < count; ++k) {
      above_[k] = k == 0 ? std::move(stack_.above_first) : above_[k - 1];
      for (std::size_t n = 0; k > 0 && n < above_[k].size(); ++n)
        above_[k][n] += stack_.thickness[k][n];
      cutAlong(k);
    }
  }

  void cutAlong(std::size_t k) {
    LevelCut cut;
    cut.field = &above_[k];
    for (std::size_t i = 0; i < horizons_.size(); ++i) {
      if (i < k)
        cut.others.push_back(&above_[i]);
      if (i > k)
        cut.others.push_back(&stack_.thickness[i]);
      cut.others.push_back(&beyond_[i]);
    }
    const std::vector<std::uint8_t> fixed = fixedVertices(k);
    cut.fixed = &fixed;
    cut.box = &o_.box;
    cut.warp = kWarp;
    cut.snap = kSnap;
    cut.threads = o_.threads;
    cut.may_snap = [this, k](Index node) {
      const auto n = static_cast<std::size_t>(node);
      return k == 0 || above_[k][n] < 0.0 || above_[k - 1][n] < 0.0;
    };
    cutAtZero(mesh_, cut);
  }

  /// On faults, the outline and the horizons above.
  std::vector<std::uint8_t> fixedVertices(std::size_t k) const {
    std::vector<std::uint8_t> fixed(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t f = 0; f < 4; ++f)
        if (mesh_.marks[c][f] != -1)
          for (const int corner : kTetrahedronFaces[f])
            fixed[static_cast<std::size_t>(mesh_.vertexOf(mesh_.cells[c][static_cast<std::size_t>(corner)]))] = 1;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t n = 0; n < above_[i].size(); ++n)
        if (above_[i][n] == 0.0)
          fixed[static_cast<std::size_t>(mesh_.node_vertex[n])] = 1;
    return fixed;
  }

  void label() {
    cells_.layer.resize(mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      Index layer = 0;
      for (const std::vector<double>& above : above_)
        layer += cellSign(mesh_.cells[c], above) < 0 ? 1 : 0;
      cells_.layer[c] = layer;
    }
    cells_.beyond.assign(mesh_.vertices.size(), 0.0);
    for (std::size_t n = 0; n < mesh_.node_vertex.size(); ++n)
      for (std::size_t k = 0; k < above_.size(); ++k)
        if (above_[k][n] == 0.0) {
          double& beyond = cells_.beyond[static_cast<std::size_t>(mesh_.node_vertex[n])];
          beyond = std::max(beyond, beyond_[k][n]);
        }
    cells_.mesh = std::move(mesh_);
    leaveOutAboveAndBelow();
    for (Tetrahedron& cell : cells_.mesh.cells)
      for (Index& corner : cell)
        corner = cells_.mesh.vertexOf(corner);
    cells_.mesh.node_vertex.resize(cells_.mesh.vertices.size());
    for (std::size_t v = 0; v < cells_.mesh.vertices.size(); ++v)
      cells_.mesh.node_vertex[v] = static_cast<Index>(v);
  }

  /// What lies above a first horizon that is the model's top, or below a last one that is its base.
  void leaveOutAboveAndBelow() {
    const auto last = static_cast<Index>(horizons_.size());
    const Index top = o_.top_is_first ? 0 : -1, base = o_.base_is_last ? last : last + 1;
    if (top < 0 && base > last)
      return;
    std::vector<std::uint8_t> kept(cells_.layer.size());
    std::vector<Index> layers;
    for (std::size_t c = 0; c < kept.size(); ++c) {
      kept[c] = cells_.layer[c] != top && cells_.layer[c] != base ? 1 : 0;
      if (kept[c] != 0)
        layers.push_back(cells_.layer[c] - (top == 0 ? 1 : 0));
    }
    if (layers.empty())
      throw InvalidInputError("model", "nothing is left between its top and its base");
    keepCells(cells_.mesh, kept, [&](std::size_t c) { return cells_.layer[c] == top ? kTopMark : kBaseMark; }, o_.threads);
    cells_.layer = std::move(layers);
  }

  /// The horizons but for those that are top and base, by name.
  std::vector<StackHorizon> horizonsInside() const {
    std::vector<StackHorizon> found;
    for (std::size_t k = o_.top_is_first ? 1 : 0; k + (o_.base_is_last ? 1 : 0) < horizons_.size(); ++k)
      found.push_back({horizons_[k].name, {}, horizons_[k].relation});
    return found;
  }

  void nameBlocks(const CellNeighbors& neighbors) {
    labelBlocks(cells_, neighbors);
    const std::size_t joined = joinSlivers(cells_, neighbors, o_.size * o_.size * o_.size);
    if (joined > 0)
      model_.notes.push_back(std::to_string(joined) + " slivers smaller than a cube of the mesh size were joined to their neighbours.");
  }

  /// Horizons that run together count each with the whole of the common surface; all but the uppermost of them have no layer above.
  void reportHorizons(const std::vector<double>& beyond) {
    const SealedMesh& sealed = model_.sealed;
    std::vector<double> area(horizons_.size(), 0.0);
    const std::size_t first = o_.top_is_first ? 1 : 0;
    for (std::size_t t = 0; t < sealed.triangles.size(); ++t) {
      const SealedPatch& patch = sealed.patchOf(t);
      if (sealed.surfaces[static_cast<std::size_t>(patch.surface)].kind != SealedSurfaceKind::Horizon)
        continue;
      const auto p = [&](std::size_t i) -> const Vector3& { return sealed.vertices[static_cast<std::size_t>(sealed.triangles[t][i])]; };
      const double size = 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
      double farthest = 0.0;
      for (const Index v : sealed.triangles[t])
        farthest = std::max(farthest, beyond[static_cast<std::size_t>(v)]);
      const auto upper = static_cast<std::size_t>(sealed.blocks[static_cast<std::size_t>(patch.in_front)].layer);
      const auto lower = static_cast<std::size_t>(sealed.blocks[static_cast<std::size_t>(patch.behind)].layer);
      for (std::size_t k = upper; k < lower; ++k) {
        StackHorizonReport& report = model_.horizons[k + first];
        area[k + first] += size;
        report.extrapolated_share += farthest > o_.size ? size : 0.0;
        report.absent_share += k > upper ? size : 0.0;
        report.farthest = std::max(report.farthest, farthest);
      }
    }
    for (std::size_t k = 0; k < area.size(); ++k)
      if (area[k] > 0.0) {
        model_.horizons[k].extrapolated_share /= area[k];
        model_.horizons[k].absent_share /= area[k];
      }
  }

  const std::vector<StackHorizon>& horizons_;
  const FaultNetwork& faults_;
  const BlockModelOptions& o_;
  TetrahedronMesh mesh_;
  Stack stack_;
  std::vector<std::vector<double>> above_;  ///< how far each node lies above each horizon
  std::vector<std::vector<double>> beyond_; ///< how far each horizon was carried on there
  LabelledCells cells_;
  BlockModel model_;
};

} // namespace

BlockModel buildBlockModel(const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options) {
  return BlockModelJob(horizons, faults, options).run();
}

} // namespace graben
