#include "file_content.h"
#include "mesh_formats.h"

#include "graben/core/errors.h"
#include "graben/io/atomic_file.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCharArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace graben {
namespace {

/// Keeps VTK's first error message instead of printing it.
class ErrorCatcher {
public:
  ErrorCatcher() {
    command_->SetClientData(&message_);
    command_->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
      auto& message = *static_cast<std::string*>(client);
      if (message.empty())
        message = text == nullptr ? "unknown error" : static_cast<const char*>(text);
    });
  }
  void watch(vtkObject& object) { object.AddObserver(vtkCommand::ErrorEvent, command_); }
  vtkCommand* command() const { return command_; }
  bool caught() const { return !message_.empty(); }

  /// VTK's message without the lines that name its source and object.
  std::string message() const {
    std::string text = message_;
    const std::size_t object = text.find("): ");
    if (object != std::string::npos)
      text = text.substr(object + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
      text.pop_back();
    return text;
  }

private:
  std::string message_;
  vtkNew<vtkCallbackCommand> command_;
};

Vector3 tupleOf(vtkDataArray& array, vtkIdType i) {
  Vector3 v;
  array.GetTuple(i, v.data());
  return v;
}

void readPointData(vtkPointData& data, std::size_t count, MeshInput& input) {
  vtkDataArray* normals = data.GetNormals();
  const auto fits = [&](vtkDataArray* array, int components) {
    return array != nullptr && array->GetNumberOfComponents() == components &&
           array->GetNumberOfTuples() == static_cast<vtkIdType>(count);
  };
  for (std::size_t v = 0; fits(normals, 3) && v < count; ++v)
    input.mesh.normals.push_back(tupleOf(*normals, static_cast<vtkIdType>(v)));
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data.GetArray(a);
    if (array == nullptr || array == normals)
      continue;
    const std::string name = array->GetName() == nullptr ? "scalar" : array->GetName();
    if (!fits(array, 1)) {
      input.notes.push_back("field ignored: " + name);
      continue;
    }
    std::vector<float>* scalar = name == "piece" ? nullptr : &input.mesh.scalars[name];
    for (vtkIdType v = 0; v < static_cast<vtkIdType>(count); ++v) {
      const double value = array->GetTuple1(v);
      if (scalar != nullptr)
        scalar->push_back(static_cast<float>(value));
      else
        input.mesh.piece.push_back(std::abs(value) < 2e9 ? static_cast<Index>(value) : 0);
    }
  }
}

void readTriangles(vtkPolyData& data, const std::string& path, TriangleMesh& mesh) {
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(&data);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  vtkCellArray& polygons = *filter->GetOutput()->GetPolys();
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (polygons.InitTraversal(); polygons.GetNextCell(size, corners) != 0;)
    if (size == 3)
      mesh.triangles.push_back({static_cast<Index>(corners[0]), static_cast<Index>(corners[1]),
                                static_cast<Index>(corners[2])});
  if (mesh.triangles.empty())
    throw ParseError(path, 0, "holds no triangle");
}

/// vtkTriangleFilter trusts the corners.
void checkCorners(vtkCellArray& cells, vtkIdType points, const std::string& path) {
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (cells.InitTraversal(); cells.GetNextCell(size, corners) != 0;)
    for (vtkIdType c = 0; c < size; ++c)
      if (corners[c] < 0 || corners[c] >= points)
        throw ParseError(path, 0,
                         "a polygon names vertex " + std::to_string(corners[c]) + " of " +
                             std::to_string(points));
}

MeshInput meshOf(vtkPolyData& data, const std::string& path) {
  MeshInput input;
  input.name = stemOf(path);
  const vtkIdType count = data.GetNumberOfPoints();
  if (count > std::numeric_limits<Index>::max())
    throw ParseError(path, 0, "more vertices than can be numbered");
  checkCorners(*data.GetPolys(), count, path);
  checkCorners(*data.GetStrips(), count, path);
  input.mesh.vertices.resize(static_cast<std::size_t>(count));
  for (vtkIdType v = 0; v < count; ++v)
    data.GetPoint(v, input.mesh.vertices[static_cast<std::size_t>(v)].data());
  readPointData(*data.GetPointData(), static_cast<std::size_t>(count), input);
  readTriangles(data, path, input.mesh);
  return input;
}

/// Runs a VTK reader; its errors become a ParseError.
template <typename Reader>
MeshInput runReader(Reader& reader, const ErrorCatcher& errors, const std::string& path) {
  try {
    reader.Update();
  } catch (const std::bad_alloc&) {
    throw ParseError(path, 0, "the file promises more data than memory can hold");
  }
  if (errors.caught())
    throw ParseError(path, 0, "cannot be read as VTK polygons: " + errors.message());
  return meshOf(*reader.GetOutput(), path);
}

vtkNew<vtkPolyData> polyDataOf(const TriangleMesh& mesh) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(mesh.vertices.size()));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    coordinates->SetTuple(static_cast<vtkIdType>(v), mesh.vertices[v].data());
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(static_cast<vtkIdType>(mesh.triangles.size()),
                           static_cast<vtkIdType>(3 * mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles)
    triangles->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

void addPointData(const TriangleMesh& mesh, vtkPointData& data) {
  if (!mesh.normals.empty()) {
    vtkNew<vtkFloatArray> normals;
    normals->SetName("normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(static_cast<vtkIdType>(mesh.normals.size()));
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
      normals->SetTuple(static_cast<vtkIdType>(v), mesh.normals[v].data());
    data.SetNormals(normals);
  }
  for (const auto& [name, values] : mesh.scalars) {
    vtkNew<vtkFloatArray> scalar;
    scalar->SetName(name.c_str());
    scalar->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    std::copy(values.begin(), values.end(), scalar->GetPointer(0));
    data.AddArray(scalar);
  }
  if (!mesh.piece.empty()) {
    vtkNew<vtkIntArray> piece;
    piece->SetName("piece");
    piece->SetNumberOfTuples(static_cast<vtkIdType>(mesh.piece.size()));
    std::copy(mesh.piece.begin(), mesh.piece.end(), piece->GetPointer(0));
    data.SetScalars(piece);
  } else if (!mesh.scalars.empty()) {
    data.SetActiveScalars(mesh.scalars.begin()->first.c_str());
  }
}

template <typename Writer>
void runWriter(Writer& writer, const std::string& path, const TriangleMesh& mesh) {
  const vtkNew<vtkPolyData> data = polyDataOf(mesh);
  addPointData(mesh, *data->GetPointData());
  AtomicFile file(path);
  ErrorCatcher errors;
  errors.watch(writer);
  writer.SetInputData(data);
  writer.SetFileName(file.temporaryPath().c_str());
  if (writer.Write() == 0 || writer.GetErrorCode() != 0)
    throw IoError(path,
                  "cannot be written: " + (errors.caught() ? errors.message() : "disk full?"));
  file.commit();
}

} // namespace

MeshInput readVtkMesh(std::string_view bytes, const std::string& path) {
  vtkNew<vtkCharArray> text;
  // VTK does not write to the array.
  text->SetArray(const_cast<char*>(bytes.data()), static_cast<vtkIdType>(bytes.size()), 1);
  vtkNew<vtkPolyDataReader> reader;
  ErrorCatcher errors;
  errors.watch(*reader);
  reader->ReadFromInputStringOn();
  reader->SetInputArray(text);
  reader->ReadAllScalarsOn();
  reader->ReadAllNormalsOn();
  if (reader->IsFilePolyData() == 0)
    throw ParseError(path, 0, "is no legacy VTK file with DATASET POLYDATA");
  return runReader(*reader, errors, path);
}

MeshInput readVtpMesh(std::string_view bytes, const std::string& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  ErrorCatcher errors;
  errors.watch(*reader);
  reader->SetReaderErrorObserver(errors.command());
  reader->SetParserErrorObserver(errors.command());
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(bytes));
  return runReader(*reader, errors, path);
}

void writeVtkMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileVersion(vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  writer->SetFileTypeToBinary();
  writer->SetHeader(
      options.name.substr(0, options.name.find_first_of("\r\n")).substr(0, 250).c_str());
  runWriter(*writer, path, mesh);
}

void writeVtpMesh(const std::string& path, const TriangleMesh& mesh) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  runWriter(*writer, path, mesh);
}

} // namespace graben
