#pragma once

#include "graben/core/export.h"

#include <pcl/PCLPointField.h>
#include <pcl/common/io.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben::detail {

/// Whether points have fields beyond place, normal and curvature, which a surface has of its own.
template <typename PointT>
bool hasFieldsToCarry() {
  static const std::set<std::string> kOwn = {"x", "y", "z", "normal_x", "normal_y", "normal_z", "curvature"};
  const std::vector<pcl::PCLPointField> fields = pcl::getFields<PointT>();
  return std::any_of(fields.begin(), fields.end(), [](const pcl::PCLPointField& f) { return kOwn.count(f.name) == 0; });
}

} // namespace graben::detail
GRABEN_EXPORT_END
