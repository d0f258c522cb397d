#pragma once

#include "graben/faults/fault_network.h"
#include "graben/synthetic/synthetic_model.h"
#include "graben/visualization/render.h"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

/// What the figures of S. Li, J. Tang, G. Wu, "Geologic Surface Reconstruction Based on Fault
/// Constraints", have in common here.
namespace graben::paper {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/// A synthetic horizon with its faults and picks, in its local frame.
struct Survey {
  SyntheticModel model;
  SyntheticPicks picks;
  std::shared_ptr<const FaultNetwork> faults;
  double spacing; ///< mean distance of picks

  explicit Survey(const SyntheticOptions& options)
      : model(options)
      , picks(model.picks())
      , spacing(options.spacing()) {
    std::vector<FaultSurface> surfaces;
    for (std::size_t f = 0; f < model.faultCount(); ++f)
      surfaces.push_back(FaultSurface::fromMesh("fault", model.faultMesh(f)));
    faults = std::make_shared<FaultNetwork>(std::move(surfaces));
  }

  Cloud::Ptr cloud() const {
    auto out = pcl::make_shared<Cloud>();
    out->resize(picks.points.size());
    for (std::size_t i = 0; i < picks.points.size(); ++i)
      (*out)[i].getVector3fMap() = picks.points[i].cast<float>();
    return out;
  }
  TriangleMesh truth() const {
    TriangleMesh all;
    for (const TriangleMesh& block : model.truthMeshes(0.5 * spacing))
      graben::append(all, block);
    return all;
  }
};

/// Draws a picture into the build folder; says so where that cannot be done.
inline void picture(const std::string& name, const SurfaceScene& scene,
                    const RenderOptions& options) {
  const Offscreen screen;
  if (!screen.available()) {
    std::cout << "No picture " << name << ": " << screen.reason() << "\n";
    return;
  }
  const std::filesystem::path folder = GRABEN_PAPER_DIR;
  std::filesystem::create_directories(folder);
  const std::string file = (folder / (name + ".png")).string();
  renderSurface(screen, file, scene, options);
  EXPECT_TRUE(std::filesystem::exists(file));
}

/// Prints a figure's number and keeps it in the test's record.
inline void tell(const std::string& what, double value) {
  std::printf("%-58s %12.4g\n", what.c_str(), value);
  testing::Test::RecordProperty(what, std::to_string(value));
}

} // namespace graben::paper
