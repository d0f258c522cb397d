#include "graben/model/model_section.h"

#include "section_rings.h"

#include "graben/core/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace graben {

namespace {

using Name = RingBuilder::Name;
using Plan = Eigen::Vector2d;

/// A straight part of a section.
struct Part {
  Plan start, unit;
  double from = 0.0, length = 0.0;
};

/// Where a triangle meets a straight part, from the edge that comes up through the plane (right to left) to the one that goes down.
struct Cut {
  Name from, to;
  SectionPoint2 a, b;
  bool open_from = false, open_to = false; ///< the ends lie where the part begins or ends
  std::size_t triangle = 0;
};

class SectionCutter {
public:
  SectionCutter(const SealedMesh& model, const std::vector<Plan>& line, bool z_down) : model_(model), z_down_(z_down), rings_(model.blocks.size()) {
    for (const Plan& p : line)
      if (!p.allFinite())
        throw InvalidInputError("section", "a point of its line is not finite");
    double whole = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      whole += (line[i + 1] - line[i]).norm();
    for (const Plan& p : line)
      if (section_.line.empty() || (p - section_.line.back()).norm() > 1e-9 * whole)
        section_.line.push_back(p);
    if (section_.line.size() < 2)
      throw InvalidInputError("section", "its line needs two different points");
    section_.bends.push_back(0.0);
    for (std::size_t i = 0; i + 1 < section_.line.size(); ++i)
      section_.bends.push_back(section_.bends.back() + (section_.line[i + 1] - section_.line[i]).norm());
  }

  ModelSection run() {
    for (std::size_t i = 0; i + 1 < section_.line.size(); ++i) {
      const Plan run = section_.line[i + 1] - section_.line[i];
      cutPart({section_.line[i], run.normalized(), section_.bends[i], run.norm()});
      joinToPrevious(i > 0);
    }
    closeAt(ends_before_, starts_before_);
    for (std::size_t b = 0; b < rings_.size(); ++b) {
      SectionPolygon polygon;
      polygon.block = static_cast<Index>(b);
      polygon.rings = rings_[b].rings();
      for (const auto& ring : polygon.rings)
        polygon.area += ringArea(ring);
      if (!polygon.rings.empty())
        section_.polygons.push_back(std::move(polygon));
    }
    if (section_.polygons.empty())
      throw InvalidInputError("section", "its line does not meet the model");
    return std::move(section_);
  }

private:
  struct BlockEnd {
    Index block;
    Name name;
  };
  using Ends = std::vector<BlockEnd>;

  const Vector3& at(Index v) const { return model_.vertices[static_cast<std::size_t>(v)]; }

  double side(Index v, const Part& part) const {
    const Plan d = at(v).head<2>() - part.start;
    return part.unit.x() * d.y() - part.unit.y() * d.x();
  }

  /// Where the plane meets an edge, computed from its lower end up, so that all triangles at the edge agree.
  SectionPoint2 crossing(Index a, Index b, const Part& part) const {
    if (a > b)
      std::swap(a, b);
    const double da = side(a, part), db = side(b, part);
    const double t = da / (da - db);
    const Vector3 p = at(a) + t * (at(b) - at(a));
    return {part.from + part.unit.dot(p.head<2>() - part.start), p.z()};
  }

  std::optional<Cut> cut(std::size_t triangle, const Part& part) const {
    const Triangle& t = model_.triangles[triangle];
    Cut result;
    result.triangle = triangle;
    int found = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = t[e], b = t[(e + 1) % 3];
      const bool left_a = side(a, part) > 0.0, left_b = side(b, part) > 0.0;
      if (left_a == left_b)
        continue;
      ++found;
      (left_b ? result.from : result.to) = Name(std::min(a, b), std::max(a, b));
      (left_b ? result.a : result.b) = crossing(a, b, part);
    }
    return found == 2 ? std::optional<Cut>(result) : std::nullopt;
  }

  /// What of the cut lies between the part's ends; false if nothing does.
  bool limit(Cut& c, const Part& part) {
    const double low = part.from, high = part.from + part.length;
    const auto place = [&](double s) { return s < low ? -1 : s > high ? 1 : 0; };
    const int pa = place(c.a.x()), pb = place(c.b.x());
    if (pa != 0 && pa == pb)
      return false;
    const SectionPoint2 a = c.a, b = c.b;
    const auto move = [&](SectionPoint2& p, int where, Name& name, bool& open) {
      if (where == 0)
        return;
      const double s = where < 0 ? low : high;
      p = a + (s - a.x()) / (b.x() - a.x()) * (b - a);
      p.x() = s;
      name = {-1, made_up_--};
      open = true;
    };
    move(c.a, pa, c.from, c.open_from);
    move(c.b, pb, c.to, c.open_to);
    return true;
  }

  void cutPart(const Part& part) {
    std::map<Name, Name> renamed; // an edge that two parts meet has a name in each
    const auto rename = [&](const Name& name) {
      if (name.first < 0)
        return name;
      const auto [place, is_new] = renamed.insert({name, {-2, made_up_}});
      if (is_new)
        --made_up_;
      return place->second;
    };
    std::map<Index, std::vector<Cut>> by_patch;
    for (std::size_t t = 0; t < model_.triangles.size(); ++t) {
      std::optional<Cut> c = cut(t, part);
      if (!c || !limit(*c, part))
        continue;
      c->from = rename(c->from);
      c->to = rename(c->to);
      addToBlocks(*c, part);
      if (isTraced(model_.patchOf(t).surface))
        by_patch[model_.triangle_patch[t]].push_back(*c);
    }
    for (const auto& [patch, cuts] : by_patch)
      trace(patch, cuts);
    findThrows(by_patch);
  }

  bool isTraced(Index surface) const {
    const SealedSurfaceKind kind = model_.surfaces[static_cast<std::size_t>(surface)].kind;
    return kind == SealedSurfaceKind::Horizon || kind == SealedSurfaceKind::Fault;
  }

  void addToBlocks(const Cut& c, const Part& part) {
    const SealedPatch& patch = model_.patchOf(c.triangle);
    if (patch.behind == patch.in_front)
      return;
    const auto add = [&](Index block, const Name& from, const SectionPoint2& a, bool open_from, const Name& to, const SectionPoint2& b, bool open_to) {
      if (block < 0)
        return;
      rings_[static_cast<std::size_t>(block)].add(from, a, to, b);
      const double middle = part.from + 0.5 * part.length;
      if (open_from)
        (a.x() < middle ? starts_begin_ : starts_end_).push_back({block, from});
      if (open_to)
        (b.x() < middle ? ends_begin_ : ends_end_).push_back({block, to});
    };
    add(patch.behind, c.from, c.a, c.open_from, c.to, c.b, c.open_to);
    add(patch.in_front, c.to, c.b, c.open_to, c.from, c.a, c.open_from);
  }

  void closeAt(const Ends& ends, const Ends& starts) {
    for (std::size_t b = 0; b < rings_.size(); ++b) {
      std::vector<Name> from, to;
      for (const BlockEnd& e : ends)
        if (e.block == static_cast<Index>(b))
          from.push_back(e.name);
      for (const BlockEnd& s : starts)
        if (s.block == static_cast<Index>(b))
          to.push_back(s.name);
      rings_[b].close(std::move(from), std::move(to));
    }
  }

  /// What ends where the last part ended goes on where this one begins, and the other way round; where they do not fit, each part is closed by itself.
  void joinToPrevious(bool has_previous) {
    if (!has_previous)
      closeAt(ends_begin_, starts_begin_);
    else if (counts(ends_before_) == counts(starts_begin_) && counts(starts_before_) == counts(ends_begin_)) {
      closeAt(ends_before_, starts_begin_);
      closeAt(ends_begin_, starts_before_);
    } else {
      closeAt(ends_before_, starts_before_);
      closeAt(ends_begin_, starts_begin_);
    }
    ends_before_ = std::move(ends_end_);
    starts_before_ = std::move(starts_end_);
    ends_end_.clear();
    starts_end_.clear();
    ends_begin_.clear();
    starts_begin_.clear();
  }

  static std::map<Index, int> counts(const Ends& ends) {
    std::map<Index, int> result;
    for (const BlockEnd& e : ends)
      ++result[e.block];
    return result;
  }

  void trace(Index patch, const std::vector<Cut>& cuts) {
    std::map<Name, std::vector<std::size_t>> at_name;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      at_name[cuts[i].from].push_back(i);
      at_name[cuts[i].to].push_back(i);
    }
    std::vector<std::uint8_t> used(cuts.size(), 0);
    const auto follow = [&](std::size_t first, Name from) {
      SectionTrace run;
      run.surface = model_.patches[static_cast<std::size_t>(patch)].surface;
      run.patch = patch;
      run.points.push_back(cuts[first].from == from ? cuts[first].a : cuts[first].b);
      for (std::size_t i = first;;) {
        used[i] = 1;
        const bool forward = cuts[i].from == from;
        from = forward ? cuts[i].to : cuts[i].from;
        run.points.push_back(forward ? cuts[i].b : cuts[i].a);
        const std::vector<std::size_t>& here = at_name.at(from);
        const auto next = std::find_if(here.begin(), here.end(), [&](std::size_t k) { return used[k] == 0; });
        if (here.size() != 2 || next == here.end())
          break;
        i = *next;
      }
      section_.traces.push_back(std::move(run));
    };
    for (const auto& [name, here] : at_name)
      if (here.size() == 1 && used[here[0]] == 0)
        follow(here[0], name);
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (used[i] == 0)
        follow(i, cuts[i].from);
  }

  /// Cutoffs: points of a horizon's trace that lie on a fault's, on the side of the blocks that both bound.
  void findThrows(const std::map<Index, std::vector<Cut>>& by_patch) {
    struct OnFault {
      Index fault, behind, in_front;
    };
    std::multimap<Name, OnFault> on_faults;
    for (const auto& [index, cuts] : by_patch) {
      const SealedPatch& patch = model_.patches[static_cast<std::size_t>(index)];
      if (model_.surfaces[static_cast<std::size_t>(patch.surface)].kind == SealedSurfaceKind::Fault)
        for (const Cut& c : cuts)
          for (const Name& name : {c.from, c.to})
            on_faults.insert({name, {patch.surface, patch.behind, patch.in_front}});
    }
    std::map<std::pair<Index, Index>, std::array<std::set<std::pair<double, double>>, 2>> cutoffs;
    for (const auto& [index, cuts] : by_patch) {
      const SealedPatch& patch = model_.patches[static_cast<std::size_t>(index)];
      if (model_.surfaces[static_cast<std::size_t>(patch.surface)].kind != SealedSurfaceKind::Horizon)
        continue;
      for (const Cut& c : cuts)
        for (const bool first : {true, false}) {
          const auto [begin, end] = on_faults.equal_range(first ? c.from : c.to);
          const SectionPoint2& p = first ? c.a : c.b;
          std::set<Index> behind, in_front;
          for (auto it = begin; it != end; ++it) {
            behind.insert(it->second.behind);
            in_front.insert(it->second.in_front);
          }
          for (auto it = begin; it != end; ++it) {
            const bool foot = behind.count(patch.behind) + behind.count(patch.in_front) == 2;
            const bool hanging = in_front.count(patch.behind) + in_front.count(patch.in_front) == 2;
            if (foot != hanging)
              cutoffs[{it->second.fault, patch.surface}][foot ? 0 : 1].insert({p.x(), p.y()});
          }
        }
    }
    for (const auto& [key, walls] : cutoffs)
      pairCutoffs(key.first, key.second, walls);
  }

  void pairCutoffs(Index fault, Index horizon, const std::array<std::set<std::pair<double, double>>, 2>& walls) {
    for (const auto& [s, z] : walls[0]) {
      const SectionPoint2 foot(s, z);
      std::optional<SectionPoint2> nearest;
      for (const auto& [hs, hz] : walls[1])
        if (!nearest || (SectionPoint2(hs, hz) - foot).norm() < (*nearest - foot).norm())
          nearest = SectionPoint2(hs, hz);
      if (nearest)
        section_.throws.push_back({fault, horizon, foot, *nearest, (z_down_ ? -1.0 : 1.0) * (foot.y() - nearest->y())});
    }
  }

  const SealedMesh& model_;
  bool z_down_;
  ModelSection section_;
  std::vector<RingBuilder> rings_;
  Ends ends_before_, starts_before_, ends_begin_, starts_begin_, ends_end_, starts_end_;
  Index made_up_ = -1;
};

Plan placeOf(const ModelSection& section, double s) {
  std::size_t i = 0;
  while (i + 2 < section.bends.size() && section.bends[i + 1] < s)
    ++i;
  const Plan run = section.line[i + 1] - section.line[i];
  return section.line[i] + (s - section.bends[i]) * run.normalized();
}

/// The horizontal direction of dip of a fault near a place: from the nearest triangles.
Plan dipDirection(const SealedMesh& model, Index fault, const Vector3& place) {
  Vector3 sum = Vector3::Zero();
  std::vector<std::pair<double, Vector3>> normals;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.patchOf(t).surface != fault)
      continue;
    const auto p = [&](std::size_t i) -> const Vector3& { return model.vertices[static_cast<std::size_t>(model.triangles[t][i])]; };
    normals.emplace_back(((p(0) + p(1) + p(2)) / 3.0 - place).norm(), (p(1) - p(0)).cross(p(2) - p(0)));
  }
  constexpr std::size_t kAround = 30;
  const std::size_t count = std::min(kAround, normals.size());
  std::partial_sort(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count), normals.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < count; ++i)
    sum += normals[i].second;
  return sum.head<2>().norm() > 0.0 ? Plan(sum.head<2>().normalized()) : Plan(1.0, 0.0);
}

/// Reads each throw off a short section along the fault's dip through the middle of the two cutoffs.
void addThrowsAlongDip(const SealedMesh& model, bool z_down, ModelSection& section) {
  for (SectionThrow& t : section.throws) {
    const SectionPoint2 middle = 0.5 * (t.footwall + t.hanging_wall);
    const Plan place = placeOf(section, middle.x());
    const Plan along = dipDirection(model, t.fault, {place.x(), place.y(), middle.y()});
    const double reach = 2.0 * (t.footwall - t.hanging_wall).norm() + 1e-3 * section.length();
    try {
      const ModelSection across = SectionCutter(model, {place - reach * along, place + reach * along}, z_down).run();
      double nearest = std::numeric_limits<double>::infinity();
      for (const SectionThrow& other : across.throws) {
        const double distance = (0.5 * (other.footwall + other.hanging_wall) - SectionPoint2(reach, middle.y())).norm();
        if (other.fault == t.fault && other.horizon == t.horizon && distance < nearest) {
          nearest = distance;
          t.along_dip = other.apparent;
        }
      }
    } catch (const InvalidInputError&) {
      continue; // beside the model
    }
  }
}

} // namespace

ModelSection cutModel(const SealedMesh& model, const std::vector<Eigen::Vector2d>& line, bool z_down) {
  ModelSection section = SectionCutter(model, line, z_down).run();
  addThrowsAlongDip(model, z_down, section);
  return section;
}

} // namespace graben
