#include "stages/reconstruction_job.h"

#include "graben/core/ticks.h"
#include "graben/surface/height_deviation.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kLeastPolygon = 0.25; // voxels squared: what is smaller is noise of a steep fault
constexpr double kLeastSlope = 0.2;    // vertical part of a normal, at least: heights of steeper surfaces mean little

/// Standard deviations at the cutoffs of one side of each fault.
class CutoffDeviations {
public:
  CutoffDeviations(const std::vector<CutoffLine>& lines, const std::vector<float>& of_vertex, std::size_t faults, int side)
    : places_(faults), values_(faults) {
    for (const CutoffLine& line : lines)
      for (std::size_t i = 0; line.side == side && i < line.points.size(); ++i) {
        places_[static_cast<std::size_t>(line.fault)].push_back(line.points[i]);
        values_[static_cast<std::size_t>(line.fault)].push_back(of_vertex[static_cast<std::size_t>(line.vertices[i])]);
      }
    for (const Points& places : places_)
      grids_.emplace_back(places, 0.0, 1);
  }

  double at(std::size_t fault, const Vector3& place) const {
    const Neighbor nearest = grids_[fault].nearestOne(place);
    return nearest.index < 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(values_[fault][static_cast<std::size_t>(nearest.index)]);
  }

private:
  std::vector<Points> places_;
  std::vector<std::vector<float>> values_;
  std::vector<NeighborGrid> grids_;
};

/// What the throw varies by, along the fault's dip. \param[in] z_scale units of x and y to one of z
void setSlipDeviations(ProfileRow& row, double z_scale) {
  const double dip = row.dip / 180.0 * M_PI;
  row.heave_deviation = z_scale * row.deviation * std::cos(dip) / std::sin(dip);
  row.dip_slip_deviation = z_scale * row.deviation / std::sin(dip);
}

} // namespace

/// A round number of about four voxels, unless asked for.
double ReconstructionJob::throwInterval() const {
  return options_.throw_interval > 0.0 ? options_.throw_interval : roundDown125(4.0 * result_.report.used.voxel_size);
}

/// Across the surface; as heights once the throws are read.
void ReconstructionJob::estimateDeviation() {
  if (!options_.deviation || !models_ || cut_.mesh.empty())
    return;
  const UsedParameters& used = result_.report.used;
  DeviationOptions o;
  o.models = *models_;
  o.zone_width = used.zone_width;
  o.threads = options_.threads;
  const LocalFit local(grid_, planes_, faults_, used.fault_reach + 4.0 * rhoPlusDelta(), mean_distance_);
  std::vector<float>& height = cut_.mesh.scalars["height_sd"];
  height = heightDeviation(cut_, *corners_, local, o);
  for (std::size_t v = 0; v < height.size(); ++v)
    height[v] = static_cast<float>(static_cast<double>(height[v]) / std::max(std::abs(cut_.mesh.normals[v].z()), kLeastSlope) / result_.frame.z_scale);
}

/// In the local frame but for its unit, which is that of the user's z.
void ReconstructionJob::estimateThrowDeviation() {
  const auto field = cut_.mesh.scalars.find("height_sd");
  if (field == cut_.mesh.scalars.end())
    return;
  const CutoffDeviations footwall(result_.cutoffs, field->second, faults_.size(), -1);
  const CutoffDeviations hanging_wall(result_.cutoffs, field->second, faults_.size(), 1);
  for (std::size_t f = 0; f < faults_.size(); ++f)
    for (ThrowSample& sample : result_.throws[f])
      sample.deviation = std::hypot(footwall.at(f, sample.footwall), hanging_wall.at(f, sample.hanging_wall));
}

void ReconstructionJob::readPolygons() {
  FaultPolygonOptions o;
  o.least_area = kLeastPolygon * std::pow(result_.report.used.voxel_size, 2);
  result_.polygons = faultPolygons(result_.throws, o);
  for (FaultPolygon& polygon : result_.polygons) {
    FaultReport& fault = result_.report.faults[static_cast<std::size_t>(polygon.fault)];
    (polygon.overlap ? fault.overlap_area : fault.gap_area) += polygon.area;
    for (Vector3& p : polygon.ring)
      p = result_.frame.toUser(p);
  }
}

void ReconstructionJob::readThrowsOff(const EdgeAdjacency& adjacency) {
  const LocalFrame& frame = result_.frame;
  result_.cutoffs = cutoffLines(cut_.mesh, cut_.vertex_faults, adjacency, &faults_, options_.threads);
  result_.throws = readThrows(result_.cutoffs, faults_, {result_.report.extrapolation.limit});
  estimateThrowDeviation();
  readPolygons();
  for (CutoffLine& line : result_.cutoffs)
    for (Vector3& p : line.points)
      p = frame.toUser(p);
  const auto toUser = [&frame](auto& row) {
    row.footwall = frame.toUser(row.footwall);
    row.hanging_wall = frame.toUser(row.hanging_wall);
    row.throw_ /= frame.z_scale;
  };
  double squares = 0.0;
  std::size_t rows = 0;
  for (std::size_t f = 0; f < faults_.size(); ++f) {
    FaultProfile profile = faultProfile(result_.throws[f], f, faults_, throwInterval());
    std::for_each(result_.throws[f].begin(), result_.throws[f].end(), toUser);
    std::for_each(profile.rows.begin(), profile.rows.end(), toUser);
    for (ProfileRow& row : profile.rows)
      setSlipDeviations(row, frame.z_scale);
    for (const ProfileRow& row : profile.rows)
      if (std::isfinite(row.deviation)) {
        squares += row.deviation * row.deviation;
        ++rows;
      }
    FaultReport& report = result_.report.faults[f];
    report.throw_length_ratio = profile.ratio;
    report.sign_changes = profile.sign_changes;
    report.roughness = profile.roughness;
    report.tips = (profile.tip_at_start ? 1 : 0) + (profile.tip_at_end ? 1 : 0);
    report.throw_ = summarize(result_.throws[f]);
    if (f < extended_.size())
      report.extended = extended_[fault_order_.given(f)];
    result_.profiles.push_back(std::move(profile));
  }
  if (rows > 0)
    result_.report.throw_deviation = std::sqrt(squares / static_cast<double>(rows));
}

} // namespace graben
