#pragma once

#include "local/local_faults.h"
#include "nearest_batch.h"
#include "plane_blend.h"

#include "graben/features/tangent_planes.h"

#include <array>

namespace graben {

/// What the field is made from.
struct FieldData {
  const NeighborGrid& grid;
  const TangentPlanes& planes;
  const FaultNetwork& faults;
  const FaultBorders& borders;
};

/// The picks around a box, for many nearest-neighbour questions about places in it.
class NearbyPicks {
public:
  void clear() { state_ = State::Untried; }
  bool untried() const { return state_ == State::Untried; }
  /// False also if there were too many to look through for each question.
  bool gathered() const { return state_ == State::Gathered; }
  /// How far from a place in the box all picks are among those gathered; the reach or more.
  double reachAt(const Vector3& v) const;
  const LocalFaults& faults() const { return faults_; }

  /// \param[in] reach how far from each place all picks are to be found
  /// \param[in] viewpoints where places may be looked at from
  void gather(const FieldData& data, const Bounds& places, double reach, const Bounds& viewpoints);

  /// The nearest picks with a plane to v that no fault hides from the viewpoint, at most \a wanted, within \a reach, nearest first (see
  /// NeighborGrid); no more than reachAt(v).
  void nearest(const Vector3& v, const Vector3& viewpoint, std::size_t wanted, double reach, std::vector<Neighbor>& out);

  /// Looks around several places of the box at once, at most NearestBatch::kPlaces of them.
  /// \param[in] places kept by reference
  void lookAround(const Vector3* places, const Vector3* viewpoints, std::size_t count);
  /// What nearest() gives for one of those places. \return false if that must be asked for: \a out may then hold picks that are not the nearest, or
  /// too few, or be as it was
  bool nearestOf(std::size_t place, std::size_t wanted, double reach, std::vector<Neighbor>& out) const;
  /// Puts the picks found near those places into \a blend with their distances.
  /// \return bit p: the first \a wanted of them at place p are what nearest() gives, all within reaches[p], if they have planes
  unsigned nearestOfAll(std::size_t wanted, const double* reaches, PlaneBlend& blend) const;

private:
  enum class State { Untried, Gathered, TooMany };
  /// Picks on the same sides of the faults (see LocalFaults::sides).
  struct Group {
    int sides;
    std::size_t first;
    std::size_t count;
  };
  void collect(const FieldData& data);
  void findSides(const FieldData& data, const Bounds& viewpoints);
  template <typename Value>
  void permute(std::vector<Value>& values) const;
  double knownBound(int sides, std::size_t wanted, double reach) const;
  void take(std::size_t pick, std::size_t wanted);
  bool noneNearer(const Group& group, float left_out, double squared_distance) const;
  bool hasPlane(Index pick) const {
    const double x = planes_->normals[static_cast<std::size_t>(pick)].x();
    return x == x;
  }
  const Vector3& place(std::size_t i) const { return points_[index_[i]]; }
  double squaredDistance(std::size_t i, const Vector3& v) const {
    const Vector3& p = place(i);
    const double dx = p.x() - v.x(), dy = p.y() - v.y(), dz = p.z() - v.z();
    return dx * dx + dy * dy + dz * dz;
  }

  State state_ = State::Untried;
  Bounds box_;
  double reach_ = 0.0;
  Vector3 centre_ = Vector3::Zero(); ///< of the box
  double scale_ = 0.0;               ///< takes coordinates from the centre of all that matters to -1 to 1
  LocalFaults faults_;
  std::vector<PointRun> runs_;
  const Vector3* points_ = nullptr;
  const TangentPlanes* planes_ = nullptr;
  std::size_t count_ = 0;                       ///< of picks; arrays may be longer
  std::vector<Index> index_;                    ///< of each, by groups
  std::vector<float> near_x_, near_y_, near_z_; ///< where they are from the centre, scaled
  std::vector<Group> groups_;                   ///< in order of their sides
  std::vector<int> sides_;                      ///< of each pick, if there are faults
  std::vector<std::uint32_t> order_;
  std::vector<double> squared_;       ///< distances of all picks in the question at hand
  std::vector<std::uint32_t> within_; ///< those that may be among the nearest
  std::vector<std::uint32_t> chosen_; ///< nearest first; of the last question until they are replaced
  const Vector3* places_ = nullptr;   ///< those looked around together
  std::size_t place_count_ = 0;
  unsigned looked_around_ = 0;        ///< bit p: place p was
  std::array<const Group*, NearestBatch::kPlaces> group_{};
  std::array<std::array<float, NearestBatch::kKept>, NearestBatch::kPlaces> found_{};
};

/// What lies around places in a box.
struct FieldNeighborhood {
  Bounds places;
  NearbyPicks near;   ///< as far as mostly needed
  NearbyPicks wider;  ///< around some of the places, for which that was not enough
  NearbyPicks far;    ///< as far as may ever be needed
  LocalFaults faults; ///< around places asked about one by one
  PlaneBlend blend;
};

} // namespace graben
