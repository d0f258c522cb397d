// vtkPCANormalEstimation + vtkSignedDistance + vtkExtractSurface, as in VTK's example ExtractSurface. The example's radius is four cells for
// an object; two suffice for cells on the surface and are four times faster. VTK leaves vertices that no triangle needs, unless --weld is given.
#include "peer.h"

#include <vtkCellArray.h>
#include <vtkExtractSurface.h>
#include <vtkNew.h>
#include <vtkPCANormalEstimation.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSignedDistance.h>

#include <cmath>

namespace {

using namespace graben::peer;

constexpr int kNeighbors = 15;
constexpr int kMargin = 2; // cells around the points
constexpr double kRadius = 2; // cells

void append(vtkPolyData* surface, Mesh& mesh) {
  mesh.vertices.resize(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    double p[3];
    surface->GetPoint(i, p);
    mesh.vertices[i] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  }
  mesh.triangles.reserve(surface->GetNumberOfPolys());
  vtkIdType corners = 0;
  const vtkIdType* ids = nullptr;
  for (surface->GetPolys()->InitTraversal(); surface->GetPolys()->GetNextCell(corners, ids);)
    mesh.triangles.push_back({static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1]), static_cast<std::int32_t>(ids[2])});
}

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  vtkSMPTools::Initialize(arguments.threads);
  Stopwatch watch;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(cloud.points.size()));
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), cloud.points[i].data());
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);

  vtkNew<vtkPCANormalEstimation> normals;
  normals->SetInputData(input);
  normals->SetSampleSize(kNeighbors);
  const Point view = viewpoint(arguments, cloud);
  normals->SetNormalOrientationToPoint();
  normals->SetOrientationPoint(view[0], view[1], view[2]);
  normals->SetFlipNormals(arguments.object);
  normals->Update();
  watch.lap("normals");

  int cells[3];
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis) {
    cells[axis] = static_cast<int>(std::ceil(cloud.size[axis] / arguments.voxel)) + 2 * kMargin;
    bounds[2 * axis] = -cells[axis] * arguments.voxel / 2;
    bounds[2 * axis + 1] = cells[axis] * arguments.voxel / 2;
  }
  vtkNew<vtkSignedDistance> distance;
  distance->SetInputConnection(normals->GetOutputPort());
  distance->SetRadius(kRadius * arguments.voxel);
  distance->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
  distance->SetBounds(bounds);
  distance->Update();
  watch.lap("distance");

  vtkNew<vtkExtractSurface> surface;
  surface->SetInputConnection(distance->GetOutputPort());
  surface->SetRadius(kRadius * arguments.voxel * 0.99);
  surface->ComputeNormalsOff();
  surface->ComputeGradientsOff();
  surface->HoleFillingOff();
  surface->Update();
  append(surface->GetOutput(), mesh);
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
