#include "scenes/scene_actors.h"

#include "graben/mesh/normals.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkContourFilter.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace graben {
namespace {

void addColor(vtkUnsignedCharArray* colors, const Color& color) {
  for (const double c : color)
    colors->InsertNextValue(static_cast<unsigned char>(255.0 * c + 0.5));
}

vtkSmartPointer<vtkUnsignedCharArray> newColors() {
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  return colors;
}

vtkSmartPointer<vtkPoints> scenePoints(const Points& points, const SceneSpace& space) {
  auto out = vtkSmartPointer<vtkPoints>::New();
  out->SetDataTypeToFloat();
  out->Allocate(static_cast<vtkIdType>(points.size()));
  for (const Vector3& p : points) {
    const Vector3 q = space.toScene(p);
    out->InsertNextPoint(q.x(), q.y(), q.z());
  }
  return out;
}

/// Shading normals of the surface as it is drawn: exaggerated.
vtkSmartPointer<vtkFloatArray> sceneNormals(const TriangleMesh& mesh, const std::vector<Triangle>& shown,
                                            const SceneSpace& space) {
  TriangleMesh drawn;
  drawn.triangles = shown;
  drawn.vertices.reserve(mesh.vertices.size());
  for (const Vector3& p : mesh.vertices)
    drawn.vertices.push_back(space.toScene(p));
  computeVertexNormals(drawn);
  auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetNumberOfComponents(3);
  for (const Vector3& n : drawn.normals)
    normals->InsertNextTuple3(n.x(), n.y(), n.z());
  return normals;
}

vtkSmartPointer<vtkPolyData> polyData(const TriangleMesh& mesh, const std::vector<Triangle>& shown,
                                      const SceneSpace& space) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(scenePoints(mesh.vertices, space));
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : shown)
    cells->InsertNextCell({vtkIdType{t[0]}, vtkIdType{t[1]}, vtkIdType{t[2]}});
  data->SetPolys(cells);
  return data;
}

void addValues(vtkPolyData* data, const ValueColors& colors) {
  vtkNew<vtkFloatArray> values;
  values->SetName("value");
  for (const float v : colors.values)
    values->InsertNextValue(v);
  data->GetPointData()->SetScalars(values);
}

vtkSmartPointer<vtkActor> actorOf(vtkPolyDataMapper* mapper) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// Lets the mapper draw what comes out of \a source, cut off at the box.
void connect(vtkPolyDataMapper* mapper, vtkAlgorithm* source, const SceneSpace& space,
             const std::optional<Bounds>& crop) {
  if (!crop) {
    mapper->SetInputConnection(source->GetOutputPort());
    return;
  }
  vtkSmartPointer<vtkAlgorithm> last = source;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool low : {true, false}) {
      const Vector3 corner = space.toScene(low ? crop->low : crop->high);
      Vector3 inward = (low ? 1.0 : -1.0) * Vector3::Unit(axis);
      if (axis == 2 && space.z_factor < 0.0)
        inward = -inward;
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(corner.x(), corner.y(), corner.z());
      plane->SetNormal(inward.x(), inward.y(), inward.z());
      vtkNew<vtkClipPolyData> clip; // one plane after the other: a box as a whole leaves ragged corners
      clip->SetInputConnection(last->GetOutputPort());
      clip->SetClipFunction(plane);
      last = clip;
    }
  mapper->SetInputConnection(last->GetOutputPort());
}

void connect(vtkPolyDataMapper* mapper, vtkPolyData* data, const SceneSpace& space, const std::optional<Bounds>& crop) {
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(data);
  connect(mapper, source, space, crop);
}

void setColor(vtkActor* actor, const Color& c) { actor->GetProperty()->SetColor(c[0], c[1], c[2]); }

} // namespace

vtkSmartPointer<vtkActor> surfaceActor(const DrawnMesh& drawn, const SceneSpace& space, const ValueColors* colors,
                                       bool edges) {
  const TriangleMesh& mesh = drawn.mesh;
  const auto data = polyData(mesh, drawn.triangles, space);
  data->GetPointData()->SetNormals(sceneNormals(mesh, drawn.triangles, space));
  vtkNew<vtkPolyDataMapper> mapper;
  if (colors != nullptr) {
    addValues(data, *colors);
    mapper->SetLookupTable(elevationColors(colors->low, colors->high, colors->reversed));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  } else {
    const auto piece_colors = newColors();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      addColor(piece_colors, pieceColor(mesh.piece.empty() ? 0 : mesh.piece[i]));
    data->GetPointData()->SetScalars(piece_colors);
  }
  connect(mapper, data, space, drawn.crop);
  auto actor = actorOf(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetAmbient(0.25);
  look->SetDiffuse(0.85);
  look->SetInterpolationToPhong();
  if (edges) {
    look->EdgeVisibilityOn();
    look->SetEdgeColor(0.25, 0.25, 0.3);
    look->SetLineWidth(1.0F);
  }
  return actor;
}

vtkSmartPointer<vtkActor> contourActor(const DrawnMesh& drawn, const SceneSpace& space, const ValueColors& colors) {
  const auto data = polyData(drawn.mesh, drawn.triangles, space);
  addValues(data, colors);
  vtkNew<vtkContourFilter> contours;
  contours->SetInputData(data);
  for (std::size_t i = 0; i < colors.contours.size(); ++i)
    contours->SetValue(static_cast<int>(i), colors.contours[i]);
  vtkNew<vtkPolyDataMapper> mapper;
  connect(mapper, contours, space, drawn.crop);
  mapper->ScalarVisibilityOff();
  auto actor = actorOf(mapper);
  setColor(actor, kDark);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetOpacity(0.45);
  actor->GetProperty()->SetLineWidth(1.2F);
  return actor;
}

vtkSmartPointer<vtkActor> faultActor(const DrawnMesh& drawn, const SceneSpace& space) {
  const auto data = polyData(drawn.mesh, drawn.triangles, space);
  data->GetPointData()->SetNormals(sceneNormals(drawn.mesh, drawn.triangles, space));
  vtkNew<vtkPolyDataMapper> mapper;
  connect(mapper, data, space, drawn.crop);
  mapper->ScalarVisibilityOff();
  auto actor = actorOf(mapper);
  setColor(actor, kFault);
  actor->GetProperty()->SetOpacity(0.4);
  actor->GetProperty()->SetAmbient(0.4);
  return actor;
}

vtkSmartPointer<vtkActor> pickActor(const Points& picks, const std::vector<Index>* piece, const SceneSpace& space,
                                    const Bounds& box, double size) {
  Points shown;
  const auto colors = newColors();
  for (std::size_t i = 0; i < picks.size(); ++i) {
    const Vector3& p = picks[i];
    if (!p.allFinite() || (p.head<2>().array() < box.low.head<2>().array()).any() ||
        (p.head<2>().array() > box.high.head<2>().array()).any())
      continue;
    shown.push_back(p);
    Color color = kDark;
    if (piece != nullptr && i < piece->size()) {
      color = pieceColor((*piece)[i]);
      std::for_each(color.begin(), color.end(), [](double& c) { c *= 0.6; });
    }
    addColor(colors, color);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(scenePoints(shown, space));
  data->GetPointData()->SetScalars(colors);
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    cells->InsertNextCell({i});
  data->SetVerts(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = actorOf(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetPointSize(static_cast<float>(size));
  return actor;
}

vtkSmartPointer<vtkActor> lineActor(const Points& line, const SceneSpace& space, double width) {
  Points finite;
  std::copy_if(line.begin(), line.end(), std::back_inserter(finite), [](const Vector3& p) { return p.allFinite(); });
  vtkNew<vtkPolyData> data;
  data->SetPoints(scenePoints(finite, space));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(finite.size()));
  for (std::size_t i = 0; i < finite.size(); ++i)
    cells->InsertCellPoint(static_cast<vtkIdType>(i));
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = actorOf(mapper);
  setColor(actor, kDark);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

} // namespace graben
