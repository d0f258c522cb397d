#include "graben/io/input_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

namespace graben {
namespace {

using Box = Eigen::AlignedBox3d;

Box boxOf(const Points& points) {
  Box box;
  for (const Vector3& p : points)
    if (p.allFinite())
      box.extend(p);
  return box;
}

Box boxOf(const FaultInput& fault) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry))
    return boxOf(mesh->vertices);
  Box box;
  for (const FaultStick& stick : std::get<std::vector<FaultStick>>(fault.geometry))
    box.extend(boxOf(stick.points));
  return box;
}

/// The box of the picks without the outermost twentieth on each side.
Box middleOf(const Points& points) {
  constexpr std::size_t kLookedAt = 100000;
  const std::size_t step = points.size() / kLookedAt + 1;
  Box box;
  Vector3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); i += step)
      values.push_back(points[i][axis]);
    const auto cut = static_cast<std::ptrdiff_t>(values.size() / 20);
    std::nth_element(values.begin(), values.begin() + cut, values.end());
    low[axis] = values[static_cast<std::size_t>(cut)];
    std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
    high[axis] = values[values.size() - 1 - static_cast<std::size_t>(cut)];
  }
  box.extend(low);
  box.extend(high);
  return box;
}

/// Up to a thousand of a fault's points.
std::set<std::array<double, 3>> someNodesOf(const FaultInput& fault) {
  constexpr std::size_t kMost = 1000;
  Points points;
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry))
    points = mesh->vertices;
  else
    for (const FaultStick& stick : std::get<std::vector<FaultStick>>(fault.geometry))
      points.insert(points.end(), stick.points.begin(), stick.points.end());
  std::set<std::array<double, 3>> nodes;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kMost + 1)
    nodes.insert({points[i].x(), points[i].y(), points[i].z()});
  return nodes;
}

/// The box of what a box becomes when each axis is scaled.
Box scaled(const Box& box, double xy, double z) {
  const Vector3 factors(xy, xy, z);
  Box result(Vector3(box.min().cwiseProduct(factors)));
  result.extend(Vector3(box.max().cwiseProduct(factors)));
  return result;
}

Box exchanged(const Box& box) {
  return {Vector3(box.min().y(), box.min().x(), box.min().z()), Vector3(box.max().y(), box.max().x(), box.max().z())};
}

double gap(const Box& a, const Box& b, int axis) {
  return std::max({0.0, a.min()[axis] - b.max()[axis], b.min()[axis] - a.max()[axis]});
}

bool farApart(const Box& a, const Box& b, int axis) {
  return gap(a, b, axis) > 0.25 * std::max(a.max()[axis] - a.min()[axis], b.max()[axis] - b.min()[axis]);
}

/// Near zero anything fits when it is made small enough; what fits must also be of a like size.
bool isOfLikeSize(double fault, double picks) {
  return fault >= 0.05 * picks;
}

std::string range(const Box& box, int axis) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g to %.6g", box.min()[axis], box.max()[axis]);
  return text;
}

double widthOf(const Box& box) {
  return std::max(box.sizes().x(), box.sizes().y());
}

struct Change {
  double factor;
  const char* what; ///< is wrong, of the faults
  const char* remedy;
};

class Comparison {
public:
  Comparison(PickSet& picks, const std::vector<FaultInput>& faults, const InputCheckOptions& options)
      : picks_(picks)
      , faults_(faults)
      , options_(options)
      , box_(boxOf(picks.points)) {
    for (const FaultInput& fault : faults)
      if (const Box box = boxOf(fault); !box.isEmpty())
        fault_boxes_.push_back(turned(fault) ? scaled(box, 1.0, -1.0) : box);
  }

  InputFindings check() {
    if (box_.isEmpty())
      return std::move(found_);
    checkSize();
    checkOutliers();
    checkFaultsArePicks();
    if (!found_.contradiction.empty())
      return std::move(found_);
    takeWayOfFaults();
    checkDegrees();
    if (!fault_boxes_.empty() && found_.contradiction.empty()) {
      checkPlaces();
      checkDepths();
    }
    if (options_.z_scale == 1.0 && found_.contradiction.empty())
      checkUnits();
    if (picks_.z_positive == ZPositive::Unknown && !options_.z_way_given)
      sayAssumption();
    return std::move(found_);
  }

private:
  bool turned(const FaultInput& fault) const {
    const ZPositive way = picks_.z_positive == ZPositive::Unknown ? ZPositive::Up : picks_.z_positive;
    return fault.z_positive != ZPositive::Unknown && fault.z_positive != way;
  }

  bool all(const std::function<bool(const Box&)>& test) const { return std::all_of(fault_boxes_.begin(), fault_boxes_.end(), test); }

  void checkSize() {
    constexpr double kNoPlace = 1e15; // beyond, a double does not tell one metre from the next
    if (std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff()) > kNoPlace)
      found_.contradiction =
          "x " + range(box_, 0) + ", y " + range(box_, 1) + ", z " + range(box_, 2) + " are too large for coordinates; check the columns and units";
  }

  /// The same file given twice.
  void checkFaultsArePicks() {
    for (const FaultInput& fault : faults_) {
      const std::set<std::array<double, 3>> nodes = someNodesOf(fault);
      const auto common = static_cast<std::size_t>(
        std::count_if(picks_.points.begin(), picks_.points.end(), [&](const Vector3& p) { return nodes.count({p.x(), p.y(), p.z()}) > 0; }));
      if (2 * common > nodes.size() && nodes.size() > 2)
        found_.contradiction = "fault " + fault.name + " (" + fault.source + ") consists of the picks of the horizon; give the fault's own surface or sticks";
    }
  }

  /// A pick or a few that lie so far away that all others are one point beside them: no surface comes of that.
  void checkOutliers() {
    constexpr double kFar = 1000.0;
    constexpr std::size_t kMostOf = 100; // at most one pick in so many, or one
    const Box middle = middleOf(picks_.points);
    const double reach = kFar * std::max(middle.sizes().maxCoeff(), 1e-9 * middle.center().cwiseAbs().maxCoeff());
    std::vector<const Vector3*> far;
    for (const Vector3& p : picks_.points)
      if ((p - middle.center()).cwiseAbs().maxCoeff() > reach)
        far.push_back(&p);
    if (far.empty() || !(reach > 0.0) || far.size() > std::max<std::size_t>(1, picks_.points.size() / kMostOf))
      return;
    char place[100];
    std::snprintf(place, sizeof place, "(%.10g, %.10g, %.10g)", far[0]->x(), far[0]->y(), far[0]->z());
    found_.contradiction = (far.size() == 1 ? std::string("one pick lies far from all others: ") :
                                              std::to_string(far.size()) + " picks lie far from all others, the first of them ") +
                           place + ", while the others span x " + range(middle, 0) + ", y " + range(middle, 1) + " and z " + range(middle, 2) +
                           "; mend the file or take them out (--null VALUE if it stands for 'no data')";
  }

  /// Picks that say nothing beside faults in depth are in depth if they lie there.
  void takeWayOfFaults() {
    const bool down = std::any_of(faults_.begin(), faults_.end(), [](const FaultInput& f) { return f.z_positive == ZPositive::Down; });
    const bool up = std::any_of(faults_.begin(), faults_.end(), [](const FaultInput& f) { return f.z_positive == ZPositive::Up; });
    if (picks_.z_positive != ZPositive::Unknown || options_.z_way_given || !down || up || fault_boxes_.empty())
      return;
    std::vector<Box> written;
    for (const FaultInput& fault : faults_)
      if (const Box box = boxOf(fault); !box.isEmpty())
        written.push_back(box);
    const bool fit = std::any_of(written.begin(), written.end(), [&](const Box& b) { return !farApart(b, box_, 2); });
    if (!fit || !all([&](const Box& b) { return farApart(b, box_, 2); }))
      return;
    picks_.z_positive = ZPositive::Down;
    picks_.z_reason = "the faults' files say depth, and the picks lie where the faults do";
    found_.notes.push_back("z of the picks is taken as depth: " + picks_.z_reason);
    fault_boxes_ = std::move(written);
  }

  void checkDegrees() {
    const Vector3 size = box_.sizes();
    const bool small =
        std::max(std::abs(box_.min().x()), std::abs(box_.max().x())) <= 180.0 && std::max(std::abs(box_.min().y()), std::abs(box_.max().y())) <= 90.0;
    const double wide = widthOf(box_);
    if (small && wide > 0.0 && wide < 10.0 && size.z() > 100.0 * wide && options_.z_scale == 1.0)
      found_.contradiction = "x (" + range(box_, 0) + ") and y (" + range(box_, 1) + ") look like degrees or kilometres beside z (" + range(box_, 2) +
                             "); project longitude and latitude to metres, or give the scale of z: --z-scale 0.001 for km beside m";
  }

  void checkPlaces() {
    const auto apart = [&](const Box& b) { return farApart(b, box_, 0) || farApart(b, box_, 1); };
    if (!all(apart))
      return;
    static const Change changes[] = {{0.3048, "in feet and the picks' in metres", "convert one of them"},
                                     {1.0 / 0.3048, "in metres and the picks' in feet", "convert one of them"},
                                     {1000.0, "in kilometres and the picks' in metres", "convert one of them"},
                                     {0.001, "in metres and the picks' in kilometres", "convert one of them"}};
    for (const Change& change : changes)
      if (all([&](const Box& b) { return !apart(scaled(b, change.factor, 1.0)) && isOfLikeSize(change.factor * widthOf(b), widthOf(box_)); }))
        return contradict(0, std::string("x and y of the faults seem to be ") + change.what, change.remedy);
    if (all([&](const Box& b) { return !apart(exchanged(b)); }))
      contradict(0, "x and y of the faults seem to be exchanged", "exchange them in one of the files");
  }

  void checkDepths() {
    if (!all([&](const Box& b) { return farApart(b, box_, 2); }))
      return;
    static const Change changes[] = {
        {-1.0, "grow the other way than the picks' (depth against elevation)",
         "say which way they grow: --fault-z-positive up or down, and --z-positive for the picks"},
        {0.3048, "be in feet and the picks' in metres", "convert one of them"},
        {1.0 / 0.3048, "be in metres and the picks' in feet", "convert one of them"},
        {1000.0, "be in seconds (or km) and the picks' in milliseconds (or m)", "convert one of them"},
        {0.001, "be in milliseconds (or m) and the picks' in seconds (or km)", "convert one of them"},
        {-0.3048, "be in feet and grow the other way than the picks' in metres", "convert one of them"},
        {-1.0 / 0.3048, "be in metres and grow the other way than the picks' in feet", "convert one of them"},
        {-1000.0, "be in seconds (or km) and grow the other way than the picks' in milliseconds (or m)", "convert one of them"},
        {-0.001, "be in milliseconds (or m) and grow the other way than the picks' in seconds (or km)", "convert one of them"}};
    for (const Change& change : changes)
      if (all([&](const Box& b) {
            return gap(scaled(b, 1.0, change.factor), box_, 2) == 0.0 && isOfLikeSize(std::abs(change.factor) * b.sizes().z(), box_.sizes().z());
          }))
        return contradict(2, std::string("z of the faults seems to ") + change.what, change.remedy);
  }

  void contradict(int axis, const std::string& what, const std::string& remedy) {
    Box faults;
    for (const Box& box : fault_boxes_)
      faults.extend(box);
    found_.contradiction = what + " (" + std::string(1, "xyz"[axis]) + " " + range(faults, axis) + " against " + range(box_, axis) + "): " + remedy +
                           "; --units-as-given if it is right as it is";
  }

  void checkUnits() {
    const auto warn = [&](const std::string& why, const std::string& scale) {
      found_.warnings.push_back(why + "; if the units of z are not those of x and y, give --z-scale: " + scale);
    };
    const std::string& xy = picks_.xy_unit;
    const std::string& z = picks_.z_unit;
    const bool metres = xy.empty() || xy == "m";
    if (z == "s")
      return warn("z is in seconds", "half the velocity, about 1000 for m");
    if (z == "ms") {
      found_.notes.push_back("z is in ms: distances take 1 ms for 1 " + (xy.empty() ? std::string("unit of x and y") : xy) +
                             "; --z-scale: half the velocity per ms, about 1 for m");
      return;
    }
    if (z == "ft" && metres)
      return warn("z is in feet" + std::string(xy.empty() ? "" : ", x and y in metres"), "0.3048 for x and y in m");
    if (z == "m" && xy == "ft")
      return warn("z is in metres, x and y in feet", "3.2808");
    if (z == "km" && metres)
      return warn("z is in kilometres", "1000 for x and y in m");
    Box everything = box_;
    for (const Box& box : fault_boxes_)
      everything.extend(box);
    const double wide = widthOf(box_);
    const double high = everything.sizes().z();
    const double least = fault_boxes_.empty() ? 1e-4 : 1e-3;
    const std::string spans = "z spans " + range(everything, 2) + " while x and y span " + range(box_, 0) + " and " + range(box_, 1);
    if (high > 0.0 && high < least * wide)
      warn(spans, "1000 for km beside m, half the velocity for seconds (about 1000 for m)");
    else if (wide > 0.0 && high > 20.0 * wide)
      warn(spans, "0.001 for m beside km");
  }

  void sayAssumption() {
    const bool above = box_.min().z() > 0.0;
    const bool below = box_.max().z() < 0.0;
    if (above || below)
      found_.notes.push_back("nothing says which way z grows; all z are " + std::string(above ? "positive" : "negative") +
                             ": taken as elevation, growing up" + (above ? "; --z-positive down if it is depth or time" : ""));
  }

  PickSet& picks_;
  const std::vector<FaultInput>& faults_;
  const InputCheckOptions& options_;
  Box box_;
  std::vector<Box> fault_boxes_; ///< turned as the picks are
  InputFindings found_;
};

} // namespace

InputFindings checkInput(PickSet& picks, const std::vector<FaultInput>& faults, const InputCheckOptions& options) {
  return Comparison(picks, faults, options).check();
}

} // namespace graben
