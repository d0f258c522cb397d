#include "scenes/annotations.h"

#include "graben/core/ticks.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double kLegendLeft = 0.885; // of the picture's width

vtkSmartPointer<vtkActor2D> shape(const vtkNew<vtkPolyData>& data, const Color& color) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  return actor;
}

} // namespace

Annotations::Annotations(int width, int height)
    : width_(width), height_(height), font_size_(std::max(8.0, height / 48.0)),
      renderer_(vtkSmartPointer<vtkRenderer>::New()) {
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
}

void Annotations::text(double x, double y, const std::string& words, Align align, double relative_size) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  actor->SetPosition(x, y);
  vtkTextProperty* look = actor->GetTextProperty();
  look->SetFontSize(static_cast<int>(relative_size * font_size_ + 0.5));
  look->SetColor(kDark[0], kDark[1], kDark[2]);
  look->SetVerticalJustificationToCentered();
  if (align == Align::Centre)
    look->SetJustificationToCentered();
  else if (align == Align::Right)
    look->SetJustificationToRight();
  renderer_->AddActor2D(actor);
}

void Annotations::line(double x0, double y0, double x1, double y1, double width) {
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x0, y0, 0.0);
  points->InsertNextPoint(x1, y1, 0.0);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({vtkIdType{0}, vtkIdType{1}});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  const auto actor = shape(data, kDark);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer_->AddActor2D(actor);
}

void Annotations::box(double x, double y, double width, double height, const Color& color) {
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, y, 0.0);
  points->InsertNextPoint(x + width, y, 0.0);
  points->InsertNextPoint(x + width, y + height, 0.0);
  points->InsertNextPoint(x, y + height, 0.0);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({vtkIdType{0}, vtkIdType{1}, vtkIdType{2}, vtkIdType{3}});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  renderer_->AddActor2D(shape(data, color));
}

void drawValueLegend(Annotations& on, const vtkLookupTable& colors, bool reversed, const std::string& name) {
  auto& table = const_cast<vtkLookupTable&>(colors); // reading a table is not const in VTK
  const double low = table.GetTableRange()[0];
  const double high = table.GetTableRange()[1];
  const double left = kLegendLeft * on.width();
  const double bar = 0.018 * on.width();
  const double bottom = 0.25 * on.height();
  const double height = 0.5 * on.height();
  const auto steps = static_cast<int>(table.GetNumberOfTableValues());
  for (int i = 0; i < steps; ++i) {
    const double* c = table.GetTableValue(i);
    const double at = reversed ? steps - 1 - i : i;
    on.box(left, bottom + height * at / steps, bar, height / steps + 1.0, {c[0], c[1], c[2]});
  }
  const std::vector<double> ticks = niceTicks(low, high, 6);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0.0;
  for (const double tick : ticks) {
    const double fraction = high > low ? (tick - low) / (high - low) : 0.5;
    const double y = bottom + height * (reversed ? 1.0 - fraction : fraction);
    on.line(left + bar, y, left + 1.3 * bar, y, 1.0);
    on.text(left + 1.5 * bar, y, tickText(tick, step), Annotations::Align::Left, 0.85);
  }
  on.text(left, bottom + height + 1.5 * on.fontSize(), name);
}

void drawPieceLegend(Annotations& on, Index pieces, const std::vector<std::string>& names) {
  constexpr Index kMost = 12;
  constexpr double kLetter = 0.55; // of the font's size
  std::size_t longest = 0;
  for (const std::string& name : names)
    longest = std::max(longest, name.size());
  const double left = std::min(kLegendLeft * on.width(), on.width() - (2.5 + kLetter * static_cast<double>(longest)) * on.fontSize());
  const double row = 1.7 * on.fontSize();
  double y = 0.75 * on.height();
  if (names.empty())
    on.text(left, y + 1.2 * row, pieces == 1 ? "1 piece" : std::to_string(pieces) + " pieces");
  for (Index i = 0; i < std::min(pieces, kMost); ++i, y -= row) {
    on.box(left, y - 0.5 * on.fontSize(), 1.4 * on.fontSize(), on.fontSize(), pieceColor(i));
    const std::string name = static_cast<std::size_t>(i) < names.size() ? names[static_cast<std::size_t>(i)] : std::to_string(i);
    on.text(left + 2.0 * on.fontSize(), y, name, Annotations::Align::Left, 0.85);
  }
  if (pieces > kMost)
    on.text(left, y, "...");
}

void drawScaleBar(Annotations& on, double units_per_pixel) {
  const double length = roundDown125(0.2 * on.width() * units_per_pixel);
  const double pixels = length / units_per_pixel;
  const double x = 0.09 * on.width();
  const double y = 0.035 * on.height();
  const double tick = 0.3 * on.fontSize();
  on.line(x, y, x + pixels, y);
  on.line(x, y - tick, x, y + tick);
  on.line(x + pixels, y - tick, x + pixels, y + tick);
  on.text(x + 0.5 * pixels, y + 0.9 * on.fontSize(), tickText(length, length), Annotations::Align::Centre, 0.85);
}

void drawNorth(Annotations& on, double right, double up) {
  const double x = 0.045 * on.width();
  const double y = 0.05 * on.height();
  const double size = 1.4 * on.fontSize();
  const double tip_x = x + size * right;
  const double tip_y = y + size * up;
  on.line(x - size * right, y - size * up, tip_x, tip_y);
  for (const double turn : {2.6, -2.6}) { // barbs, in radians from the shaft
    const double barb_x = right * std::cos(turn) - up * std::sin(turn);
    const double barb_y = right * std::sin(turn) + up * std::cos(turn);
    on.line(tip_x, tip_y, tip_x + 0.5 * size * barb_x, tip_y + 0.5 * size * barb_y);
  }
  const double reach = std::max(1.0, 0.8 / std::max(0.2, std::hypot(right, up)));
  on.text(x + 1.6 * reach * size * right, y + 1.6 * reach * size * up, "N", Annotations::Align::Centre, 0.85);
}

} // namespace graben
