#include "two_levels.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

#include <cstdlib>
#include <functional>
#include <new>

namespace {

long allocations_left = -1; ///< until one fails; negative: none does
bool gave_out = false;

void* allocate(std::size_t bytes) {
  if (allocations_left == 0) {
    allocations_left = -1;
    gave_out = true;
    throw std::bad_alloc();
  }
  if (allocations_left > 0)
    --allocations_left;
  void* memory = std::malloc(bytes > 0 ? bytes : 1);
  if (memory == nullptr)
    throw std::bad_alloc();
  return memory;
}

} // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace graben {
namespace {

/// Nothing leaves a class, wherever memory gives out: it says that it failed.
class OutOfMemory : public test::Contract {
protected:
  /// Runs \a work with one allocation after another failing, ever farther apart, until it gets through. \param[in] failed whether the class says so
  static void giveOut(const std::function<void()>& work, const std::function<bool()>& failed) {
    long first = 0;
    std::size_t failures = 0;
    for (bool through = false; !through; first += 1 + first / 3) {
      allocations_left = first;
      gave_out = false;
      ASSERT_NO_THROW(work()) << "at allocation " << first;
      through = !gave_out;
      allocations_left = -1;
      ASSERT_EQ(failed(), !through) << "at allocation " << first;
      failures += through ? 0 : 1;
    }
    EXPECT_GT(failures, 5U);
  }
};

TEST_F(OutOfMemory, TheNormalsFail) {
  FaultConstrainedNormalEstimation<pcl::PointXYZ, pcl::PointNormal> normals(1);
  normals.setInputCloud(test::twoLevels<pcl::PointXYZ>(5.0));
  normals.setFaults(test::uprightFault());
  giveOut(
      [&] {
        pcl::PointCloud<pcl::PointNormal> out;
        normals.compute(out);
      },
      [&] { return normals.getStatus() == NormalEstimationStatus::Failed; });
}

TEST_F(OutOfMemory, TheFiltersFail) {
  FaultZone<pcl::PointXYZ> zone(true);
  WrongSidePicks<pcl::PointXYZ> wrong;
  for (FaultFilter<pcl::PointXYZ>* filter : std::initializer_list<FaultFilter<pcl::PointXYZ>*>{&zone, &wrong}) {
    filter->setInputCloud(test::twoLevels<pcl::PointXYZ>(5.0));
    filter->setFaults(test::uprightFault());
    filter->setNumberOfThreads(1);
    const auto failed = [&] { return filter->getStatus() == FilterStatus::Failed; };
    giveOut(
        [&] {
          pcl::PointCloud<pcl::PointXYZ> out;
          filter->filter(out);
        },
        failed);
  }
}

TEST_F(OutOfMemory, TheSurfaceFails) {
  HoppeMarchingCubes<pcl::PointXYZRGBNormal> cubes;
  cubes.setInputCloud(test::twoLevels<pcl::PointXYZRGBNormal>(5.0));
  cubes.setFaults(test::uprightFault());
  cubes.setNumberOfThreads(1);
  const auto failed = [&] { return cubes.getStatus() == SurfaceStatus::Failed; };
  giveOut(
      [&] {
        pcl::PolygonMesh out;
        cubes.reconstruct(out);
      },
      failed);
}

TEST_F(OutOfMemory, CutterAndFitterFail) {
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  const auto cloud = test::twoLevels<pcl::PointNormal>(5.0);
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>();
  cubes.setInputCloud(cloud);
  cubes.reconstruct(*mesh);
  FaultCutter cutter;
  QEMFaultFitter fitter;
  fitter.setInputCloud(cloud);
  for (FaultMeshProcessing* step : std::initializer_list<FaultMeshProcessing*>{&cutter, &fitter}) {
    step->setInputMesh(mesh);
    step->setFaults(test::uprightFault());
    step->setNumberOfThreads(1);
    giveOut(
        [&] {
          pcl::PolygonMesh out;
          step->process(out);
        },
        [&] { return step->getStatus() == SurfaceStatus::Failed; });
  }
}

TEST_F(OutOfMemory, TheWholeJobFails) {
  FaultedHorizonReconstruction<pcl::PointXYZRGB> job;
  job.setInputCloud(test::twoLevels<pcl::PointXYZRGB>(5.0));
  job.setFaults(test::uprightFault());
  job.setNumberOfThreads(1);
  giveOut(
      [&] {
        pcl::PolygonMesh out;
        job.reconstruct(out);
      },
      [&] { return job.getStatus() == SurfaceStatus::Failed; });
}

} // namespace
} // namespace graben
