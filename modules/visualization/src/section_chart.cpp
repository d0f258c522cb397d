#include "graben/visualization/section.h"

#include "palette.h"
#include "picture_file.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"
#include "graben/mesh/bounds.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace graben {
namespace {

constexpr const char* kStage = "drawing a section";

/// How one set of lines or dots looks.
struct Look {
  Color color = kDark;
  float width = 2.0F;
  bool dashed = false;
  std::string name; ///< in the legend; empty: not there
};

/// Collects what is plotted; heights are negated where z grows downward, and the axis labels negated back.
class Chart {
public:
  Chart(vtkChartXY* chart, double z_factor) : chart_(chart), z_factor_(z_factor) {}

  void addSegments(const std::vector<SectionSegment>& segments, const Look& look) {
    vtkNew<vtkPlotLine> plot;
    plot->SetPolyLine(false);
    plot->GetPen()->SetLineType(look.dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
    std::vector<Eigen::Vector2d> ends;
    for (const SectionSegment& segment : segments)
      ends.insert(ends.end(), segment.ends.begin(), segment.ends.end());
    add(plot, ends, look);
  }

  void addDots(const std::vector<Eigen::Vector2d>& dots, const Look& look) {
    vtkNew<vtkPlotPoints> plot;
    plot->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    plot->SetMarkerSize(look.width);
    add(plot, dots, look);
  }

  bool empty() const { return range_.empty(); }
  const Bounds& range() const { return range_; }
  double zFactor() const { return z_factor_; }

private:
  void add(vtkPlot* plot, const std::vector<Eigen::Vector2d>& points, const Look& look) {
    if (points.empty())
      return;
    vtkNew<vtkDoubleArray> s;
    vtkNew<vtkDoubleArray> z;
    s->SetName("s");
    z->SetName("z");
    for (const Eigen::Vector2d& p : points) {
      s->InsertNextValue(p.x());
      z->InsertNextValue(z_factor_ * p.y());
      range_.extend(Vector3(p.x(), z_factor_ * p.y(), 0.0));
    }
    vtkNew<vtkTable> table;
    table->AddColumn(s);
    table->AddColumn(z);
    plot->SetInputData(table, 0, 1);
    plot->GetPen()->SetColorF(look.color[0], look.color[1], look.color[2]);
    plot->SetWidth(look.width);
    plot->SetLabel(look.name);
    plot->SetLegendVisibility(!look.name.empty());
    chart_->AddPlot(plot);
  }

  vtkChartXY* chart_;
  double z_factor_;
  Bounds range_;
};

std::vector<Eigen::Vector2d> picksInBand(const Points& picks, const SectionLine& line, double band) {
  const Eigen::Vector2d along = (line.b - line.a).head<2>();
  const double length = along.norm();
  const Eigen::Vector2d unit = along / length;
  std::vector<Eigen::Vector2d> dots;
  for (const Vector3& p : picks) {
    const Eigen::Vector2d from_start = (p - line.a).head<2>();
    const double s = unit.dot(from_start);
    const double d = unit.x() * from_start.y() - unit.y() * from_start.x();
    if (p.allFinite() && s >= 0.0 && s <= length && std::abs(d) <= band)
      dots.push_back({s, p.z()});
  }
  return dots;
}

void plotScene(Chart& chart, const SectionScene& scene, const SectionLine& line, const SectionOptions& options,
               float stroke) {
  const double band = options.band > 0.0 ? options.band : 0.01 * (line.b - line.a).head<2>().norm();
  if (scene.picks != nullptr)
    chart.addDots(picksInBand(*scene.picks, line, band), {{0.45, 0.47, 0.50}, 2.5F * stroke, false, "picks"});
  if (scene.mesh != nullptr) {
    std::map<Index, std::vector<SectionSegment>> by_piece;
    for (const SectionSegment& segment : cutMesh(*scene.mesh, line)) {
      const auto vertex = static_cast<std::size_t>(scene.mesh->triangles[static_cast<std::size_t>(segment.triangle)][0]);
      by_piece[scene.mesh->piece.empty() ? 0 : scene.mesh->piece[vertex]].push_back(segment);
    }
    for (const auto& [piece, segments] : by_piece)
      chart.addSegments(segments, {pieceColor(piece), 2.5F * stroke, false,
                                   scene.mesh->piece.empty() ? "surface" : "piece " + std::to_string(piece)});
  }
  for (const TriangleMesh* truth : scene.truth)
    chart.addSegments(cutMesh(*truth, line), {kDark, 1.2F * stroke, true, truth == scene.truth.front() ? "truth" : ""});
}

/// Faults reach far over and under a horizon: only what is near it is drawn.
void plotFaults(Chart& chart, const SectionScene& scene, const SectionLine& line, float stroke) {
  const Bounds range = chart.range();
  const double margin = 0.15 * range.size().y() + 0.01 * range.size().x();
  for (const TriangleMesh* fault : scene.faults) {
    std::vector<SectionSegment> segments = cutMesh(*fault, line);
    if (!range.empty())
      segments.erase(std::remove_if(segments.begin(), segments.end(),
                                    [&](const SectionSegment& segment) {
                                      const double z0 = chart.zFactor() * segment.ends[0].y();
                                      const double z1 = chart.zFactor() * segment.ends[1].y();
                                      return std::max(z0, z1) < range.low.y() - margin ||
                                             std::min(z0, z1) > range.high.y() + margin;
                                    }),
                     segments.end());
    chart.addSegments(segments, {kFault, 2.0F * stroke, false, fault == scene.faults.front() ? "faults" : ""});
  }
}

/// Fixes an axis with round ticks; labels are the values times \a factor.
void setAxis(vtkAxis* axis, double low, double high, double factor, int font_size, const std::string& title) {
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(low, high);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  const std::vector<double> ticks = niceTicks(low, high, 8);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0.0;
  for (const double tick : ticks) {
    positions->InsertNextValue(tick);
    labels->InsertNextValue(tickText(tick == 0.0 ? 0.0 : factor * tick, step));
  }
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle(title);
  axis->GetLabelProperties()->SetFontSize(font_size);
  axis->GetTitleProperties()->SetFontSize(font_size);
  axis->GetTitleProperties()->BoldOff();
  axis->GetGridPen()->SetColor(225, 225, 230);
}

/// Sets both axes. \return the vertical exaggeration of the picture
double setAxes(vtkChartXY* chart, const Bounds& range, double length, double z_factor, const SectionOptions& options) {
  const int font = std::max(9, options.height / 36);
  const double plot_wide = 0.88 * options.width;
  const double plot_high = 0.76 * options.height;
  const double middle = 0.5 * (range.low.y() + range.high.y());
  double height = std::max(1.1 * range.size().y(), 1e-3 * length);
  if (options.vertical_exaggeration > 0.0)
    height = length / plot_wide * plot_high / options.vertical_exaggeration;
  const double exaggeration = (length / plot_wide) / (height / plot_high);

  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(0.0F, 0.0F, static_cast<float>(options.width), static_cast<float>(options.height)));
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetAutoAxes(false);
  setAxis(chart->GetAxis(vtkAxis::BOTTOM), 0.0, length, 1.0, font, "distance along the section");
  setAxis(chart->GetAxis(vtkAxis::LEFT), middle - 0.5 * height, middle + 0.5 * height, z_factor, font, "z");
  chart->SetSize(vtkRectf(static_cast<float>(0.09 * options.width), static_cast<float>(0.13 * options.height),
                          static_cast<float>(plot_wide), static_cast<float>(plot_high)));
  return exaggeration;
}

std::vector<const TriangleMesh*> allMeshes(const SectionScene& scene) {
  std::vector<const TriangleMesh*> all = scene.faults;
  all.insert(all.end(), scene.truth.begin(), scene.truth.end());
  if (scene.mesh != nullptr)
    all.push_back(scene.mesh);
  return all;
}

} // namespace

void renderSection(const Offscreen& screen, const std::string& png, const SectionScene& scene, const SectionLine& line,
                   const SectionOptions& options) {
  if (!screen.available())
    throw Error(kStage, screen.reason());
  checkPictureSize(options.width, options.height);
  for (const TriangleMesh* mesh : allMeshes(scene))
    validate(*mesh, kStage);
  const double length = (line.b - line.a).head<2>().norm();
  const float stroke = static_cast<float>(options.height) / 500.0F;

  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkRenderWindow> window;
  window->SetDisplayId(screen.connection());
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetSize(options.width, options.height);
  window->AddRenderer(paper);

  vtkNew<vtkChartXY> axes;
  Chart chart(axes, options.z_positive == ZPositive::Down ? -1.0 : 1.0);
  plotScene(chart, scene, line, options, stroke);
  plotFaults(chart, scene, line, stroke);
  if (chart.empty())
    throw InvalidInputError(kStage, "nothing to draw meets the section");
  const double exaggeration = setAxes(axes, chart.range(), length, chart.zFactor(), options);
  const double rounded = roundDown125(exaggeration);
  axes->SetShowLegend(true);
  axes->GetLegend()->SetLabelSize(std::max(9, options.height / 40));
  axes->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  axes->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  axes->SetTitle((options.title.empty() ? "" : options.title + "   ") + "(vertical exaggeration " +
                 tickText(exaggeration, 0.1 * rounded) + ")");
  axes->GetTitleProperties()->SetFontSize(std::max(10, options.height / 30));
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(axes);
  paper->AddActor(actor);
  writePicture(window, png);
}

} // namespace graben
