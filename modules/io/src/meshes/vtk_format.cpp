#include "content/file_content.h"
#include "meshes/mesh_formats.h"
#include "meshes/vtk_cells.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <type_traits>

namespace graben {
namespace {

/// Keeps what VTK has to complain about instead of printing it. VTK has one place for messages, so
/// only one thread at a time may be in VTK here.
class MessageCatcher : public vtkOutputWindow {
public:
  static MessageCatcher* New() {
    auto* catcher = new MessageCatcher;
    catcher->InitializeObjectBase();
    return catcher;
  }

  void DisplayText(const char* text) override {
    if (text_.empty() && text != nullptr)
      text_ = text;
  }
  void DisplayErrorText(const char* text) override { DisplayText(text); }
  void DisplayWarningText(const char* text) override { DisplayText(text); }
  void DisplayGenericWarningText(const char* text) override { DisplayText(text); }
  void DisplayDebugText(const char*) override {}

  bool caught() const { return !text_.empty(); }

  /// VTK's first message without the parts that name its source and object.
  std::string message() const {
    const std::size_t object = text_.find("): ");
    std::string text = object == std::string::npos ? text_ : text_.substr(object + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }

private:
  std::string text_;
};

class CatchMessages {
public:
  CatchMessages()
    : lock_(guard()), former_window_(vtkOutputWindow::GetInstance()),
      former_verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(catcher_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~CatchMessages() {
    vtkOutputWindow::SetInstance(former_window_);
    vtkLogger::SetStderrVerbosity(former_verbosity_);
  }
  CatchMessages(const CatchMessages&) = delete;
  CatchMessages& operator=(const CatchMessages&) = delete;
  const MessageCatcher* operator->() const { return catcher_; }

private:
  static std::mutex& guard() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  vtkSmartPointer<vtkOutputWindow> former_window_;
  vtkLogger::Verbosity former_verbosity_;
  vtkNew<MessageCatcher> catcher_;
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

/// The dataset's type as the file's first element has it.
std::string vtkXmlType(std::string_view bytes) {
  const std::size_t element = bytes.find("<VTKFile");
  const std::string_view tag = element == std::string_view::npos ? std::string_view{} : bytes.substr(element, bytes.find('>', element) - element);
  const std::size_t type = tag.find("type=");
  if (type == std::string_view::npos || type + 6 >= tag.size())
    return {};
  const std::size_t end = tag.find(tag[type + 5], type + 6);
  return std::string(tag.substr(type + 6, end == std::string_view::npos ? end : end - type - 6));
}

template <typename Reader>
vtkSmartPointer<Reader> readXml(std::string_view bytes) {
  auto reader = vtkSmartPointer<Reader>::New();
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(bytes));
  reader->Update();
  return reader;
}

void addPolygon(vtkCellArray& polygons, const std::vector<double>& corners) {
  std::vector<vtkIdType> ids(corners.begin(), corners.end());
  polygons.InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
}

vtkSmartPointer<vtkPolyData> polygonsOf(vtkPointSet& set, vtkCellArray& polygons) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(set.GetPoints());
  data->SetPolys(&polygons);
  data->GetPointData()->ShallowCopy(set.GetPointData());
  return data;
}

vtkSmartPointer<vtkPolyData> polygonsOf(vtkStructuredGrid& grid, const std::string& path) {
  int size[3] = {0, 0, 0};
  grid.GetDimensions(size);
  vtkNew<vtkCellArray> polygons;
  const auto add = [&](const std::vector<double>& corners) { addPolygon(*polygons, corners); };
  const std::array<std::size_t, 3> nodes{static_cast<std::size_t>(std::max(size[0], 0)), static_cast<std::size_t>(std::max(size[1], 0)),
                                         static_cast<std::size_t>(std::max(size[2], 0))};
  if (!addGridPolygons(nodes, add))
    throw ParseError(path, 0, "is a structured grid of " + gridSize(nodes) + " points, not a surface");
  return polygonsOf(static_cast<vtkPointSet&>(grid), *polygons);
}

vtkSmartPointer<vtkPolyData> polygonsOf(vtkUnstructuredGrid& grid, const std::string& path) {
  vtkNew<vtkCellArray> polygons;
  const auto add = [&](const std::vector<double>& corners) { addPolygon(*polygons, corners); };
  vtkCellArray* cells = grid.GetCells();
  const vtkIdType count = cells == nullptr ? 0 : cells->GetNumberOfCells();
  vtkIdType corners = 0;
  for (vtkIdType c = 0; c < count; ++c) {
    if (cells->GetCellSize(c) < 0)
      throw ParseError(path, 0, "the offsets of the cells contradict one another");
    corners += cells->GetCellSize(c);
  }
  if (cells != nullptr && corners != cells->GetNumberOfConnectivityIds())
    throw ParseError(path, 0, "the offsets of the cells contradict one another");
  vtkNew<vtkIdList> ids;
  std::vector<double> cell;
  std::size_t others = 0;
  for (vtkIdType c = 0; c < count; ++c) {
    cells->GetCellAtId(c, ids);
    cell.assign(ids->begin(), ids->end());
    others += addCellPolygons(grid.GetCellType(c), cell, add) ? 0 : 1;
  }
  if (polygons->GetNumberOfCells() == 0)
    throw ParseError(path, 0, "holds no surface: its " + std::to_string(others) + " cells are volumes, lines or points");
  return polygonsOf(static_cast<vtkPointSet&>(grid), *polygons);
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

template <typename Array>
void addArray(const std::string& name, const std::vector<float>& values, vtkPointData& data) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  if constexpr (std::is_same_v<Array, vtkFloatArray>)
    std::copy(values.begin(), values.end(), array->GetPointer(0));
  else
    std::transform(values.begin(), values.end(), array->GetPointer(0), flagOf);
  data.AddArray(array);
}

void addPointData(const TriangleMesh& mesh, const MeshWriteOptions& options, vtkPointData& data) {
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
    if (options.flags.count(name) > 0)
      addArray<vtkUnsignedCharArray>(name, values, data);
    else
      addArray<vtkFloatArray>(name, values, data);
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

std::string writtenText(vtkPolyDataWriter& writer) {
  writer.WriteToOutputStringOn();
  writer.Write();
  return writer.GetOutputStdString();
}

std::string writtenText(vtkXMLPolyDataWriter& writer) {
  writer.WriteToOutputStringOn();
  writer.Write();
  return writer.GetOutputString();
}

template <typename Writer>
void runWriter(Writer& writer, const std::string& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  const vtkNew<vtkPolyData> data = polyDataOf(mesh);
  addPointData(mesh, options, *data->GetPointData());
  AtomicFile file(path);
  const CatchMessages messages;
  writer.SetInputData(data);
  if (file.writingPath() == path) { // a device or a pipe, or a link to one: VTK would remove it if it took no data
    file.write(writtenText(writer));
    file.commit();
    return;
  }
  writer.SetFileName(file.writingPath().c_str());
  if (writer.Write() == 0 || writer.GetErrorCode() != 0)
    throw WriteError(path, "cannot be written: the disk is full, or the device takes no data");
  file.commit();
}

} // namespace

MeshInput readVtkXmlMesh(std::string_view bytes, const std::string& path) {
  const CatchMessages messages;
  const std::string type = vtkXmlType(bytes);
  const auto failed = [&](const std::string& what) {
    if (messages->caught())
      throw ParseError(path, 0, "cannot be read as VTK " + what + ": " + messages->message());
  };
  try {
    if (type == "StructuredGrid") {
      const auto grid = readXml<vtkXMLStructuredGridReader>(bytes);
      failed("structured grid");
      return meshOf(*polygonsOf(*grid->GetOutput(), path), path);
    }
    if (type == "UnstructuredGrid") {
      const auto grid = readXml<vtkXMLUnstructuredGridReader>(bytes);
      failed("unstructured grid");
      return meshOf(*polygonsOf(*grid->GetOutput(), path), path);
    }
    const auto polygons = readXml<vtkXMLPolyDataReader>(bytes);
    failed("polygons");
    if (polygons->GetErrorCode() != 0)
      throw ParseError(path, 0, "cannot be read as VTK polygons");
    return meshOf(*polygons->GetOutput(), path);
  } catch (const std::bad_alloc&) {
    throw ParseError(path, 0, "the file promises more data than memory can hold");
  }
}

void writeVtkMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileVersion(vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  writer->SetFileTypeToBinary();
  writer->SetHeader(
      options.name.substr(0, options.name.find_first_of("\r\n")).substr(0, 250).c_str());
  runWriter(*writer, path, mesh, options);
}

void writeVtpMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  runWriter(*writer, path, mesh, options);
}

} // namespace graben
