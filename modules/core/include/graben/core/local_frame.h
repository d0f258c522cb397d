#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// The frame all algorithms work in: near the origin, z up, z scaled so that distances make sense.
///
/// local = (x - origin.x, y - origin.y, sign * scale * (z - origin.z)), sign -1 where the user's z grows downward.
/// The origin is subtracted in double before anything is stored in float: float32 steps are 0.5 m at UTM northings.
/// Thread-safe after construction. toUser(toLocal(p)) returns p to a few units in the last place of p.
struct LocalFrame {
  Vector3 origin = Vector3::Zero();
  double z_scale = 1.0;                  ///< positive; user's z units to x, y units (1: the same unit)
  ZPositive z_positive = ZPositive::Up;  ///< which way the user's z grows; Unknown counts as Up

  /// Origin at the centre of the finite points' bounding box, rounded to whole units. \param[in] threads 0: one per processor
  /// \throw InvalidInputError if no point is finite or z_scale is not positive and finite
  static LocalFrame around(const Points& points, ZPositive z_positive = ZPositive::Up, double z_scale = 1.0, unsigned threads = 0);

  /// The factor on z: negative where the user's z grows downward.
  double zFactor() const { return z_positive == ZPositive::Down ? -z_scale : z_scale; }

  /// True where going from one frame to the other mirrors, so that triangles must change their winding.
  bool mirrors() const { return z_positive == ZPositive::Down; }

  Vector3 toLocal(const Vector3& user) const;
  Vector3 toUser(const Vector3& local) const;

  /// A unit normal of a local surface as the unit normal of the same surface in the user's frame.
  Vector3 normalToUser(const Vector3& local) const;
  Vector3 normalToLocal(const Vector3& user) const;
};

} // namespace graben
GRABEN_EXPORT_END
