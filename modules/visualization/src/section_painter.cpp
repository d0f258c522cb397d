#include "picture_file.h"
#include "section_layout.h"
#include "ticks.h"

#include "graben/core/errors.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// Paints the same as the SVG has; y up, in pixels.
class SectionItem : public vtkContextItem {
public:
  static SectionItem* New();
  vtkTypeMacro(SectionItem, vtkContextItem)

  void show(const SectionDrawing& drawing, const SectionLayout& layout) {
    d_ = &drawing;
    l_ = &layout;
  }

  bool Paint(vtkContext2D* painter) override {
    painter_ = painter;
    for (const DrawnArea& area : d_->areas)
      fill(area);
    for (const Eigen::Vector2d& dot : d_->dots)
      spot(place(dot));
    for (const DrawnLine& line : d_->lines)
      polyline(line);
    for (const double bend : d_->bends)
      line({x(bend), y(l_->top)}, {x(bend), y(l_->top + l_->height)}, {0.33, 0.33, 0.33}, 1.0, true);
    for (const DrawnLabel& label : d_->labels)
      text(place(label.at) + Eigen::Vector2d(0.5 * l_->font, -0.3 * l_->font), label.text, VTK_TEXT_LEFT, 0.8);
    frame();
    legend();
    return true;
  }

private:
  double y(double down) const { return d_->height - down; }
  double x(double s) const { return l_->left + s / l_->length * l_->width; }
  Eigen::Vector2d place(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d pixel = l_->pixel(p);
    return {pixel.x(), y(pixel.y())};
  }

  void brush(const Color& color) {
    painter_->GetBrush()->SetColorF(color[0], color[1], color[2], 1.0);
    painter_->GetPen()->SetLineType(vtkPen::NO_PEN);
  }

  void pen(const Color& color, double width, bool dashed = false) {
    painter_->GetPen()->SetLineType(dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
    painter_->GetPen()->SetColorF(color[0], color[1], color[2]);
    painter_->GetPen()->SetWidth(static_cast<float>(width));
  }

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Color& color, double width, bool dashed = false) {
    pen(color, width, dashed);
    painter_->DrawLine(static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(b.x()), static_cast<float>(b.y()));
  }

  /// Columns a pixel wide, each filled between the rings' edges over it: right for any polygon with holes.
  void fill(const DrawnArea& area) {
    brush(layerColor(area.layer_number));
    std::vector<std::vector<double>> columns(static_cast<std::size_t>(std::max(1.0, std::ceil(l_->width))));
    for (const auto& ring : area.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        Eigen::Vector2d a = place(ring[i]), b = place(ring[(i + 1) % ring.size()]);
        if (a.x() > b.x())
          std::swap(a, b);
        const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(a.x() - l_->left - 0.5)));
        for (std::size_t c = first; c < columns.size() && l_->left + static_cast<double>(c) + 0.5 < b.x(); ++c)
          columns[c].push_back(a.y() + (l_->left + static_cast<double>(c) + 0.5 - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
      }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::sort(columns[c].begin(), columns[c].end());
      for (std::size_t i = 0; i + 1 < columns[c].size(); i += 2)
        painter_->DrawRect(static_cast<float>(l_->left + static_cast<double>(c)), static_cast<float>(columns[c][i]), 1.0F,
                           static_cast<float>(columns[c][i + 1] - columns[c][i]));
    }
  }

  void spot(const Eigen::Vector2d& at) {
    brush({0.35, 0.37, 0.40});
    const auto size = static_cast<float>(0.2 * l_->font);
    painter_->DrawRect(static_cast<float>(at.x()) - 0.5F * size, static_cast<float>(at.y()) - 0.5F * size, size, size);
  }

  void polyline(const DrawnLine& drawn) {
    pen(drawn.is_fault ? kFault : kHorizonLine, (drawn.is_fault ? 0.16 : 0.11) * l_->font);
    std::vector<float> points;
    for (const Eigen::Vector2d& p : drawn.points) {
      const Eigen::Vector2d at = place(p);
      points.push_back(static_cast<float>(at.x()));
      points.push_back(static_cast<float>(at.y()));
    }
    if (drawn.points.size() > 1)
      painter_->DrawPoly(points.data(), static_cast<int>(drawn.points.size()));
  }

  void text(const Eigen::Vector2d& at, const std::string& what, int justification, double size = 1.0, double angle = 0.0) {
    vtkTextProperty* property = painter_->GetTextProp();
    property->SetColor(0.1, 0.1, 0.12);
    property->SetFontSize(static_cast<int>(std::lround(0.92 * size * l_->font)));
    property->SetJustification(justification);
    property->SetVerticalJustificationToCentered();
    property->SetOrientation(angle);
    painter_->DrawString(static_cast<float>(std::round(at.x())), static_cast<float>(std::round(at.y())), what); // between pixels it smears
  }

  void frame() {
    const double bottom = y(l_->top + l_->height), top = y(l_->top), right = l_->left + l_->width;
    const Color ink{0.13, 0.13, 0.13};
    line({l_->left, bottom}, {right, bottom}, ink, 1.0);
    line({l_->left, top}, {right, top}, ink, 1.0);
    line({l_->left, bottom}, {l_->left, top}, ink, 1.0);
    line({right, bottom}, {right, top}, ink, 1.0);
    const std::vector<double> along = niceTicks(0.0, l_->length, 8);
    for (const double s : along) {
      line({x(s), bottom}, {x(s), bottom - 0.4 * l_->font}, ink, 1.0);
      text({x(s), bottom - 1.2 * l_->font}, tickText(s, along.size() > 1 ? along[1] - along[0] : 0.0), VTK_TEXT_CENTERED);
    }
    const std::vector<double> heights = niceTicks(l_->low, l_->high, 8);
    for (const double z : heights) {
      const double at = y(l_->top + (l_->high - z) / (l_->high - l_->low) * l_->height);
      line({l_->left - 0.4 * l_->font, at}, {l_->left, at}, ink, 1.0);
      text({l_->left - 0.6 * l_->font, at}, tickText(z == 0.0 ? 0.0 : l_->z_factor * z, heights.size() > 1 ? heights[1] - heights[0] : 0.0), VTK_TEXT_RIGHT);
    }
    const double middle = l_->left + 0.5 * l_->width;
    text({middle, bottom - 2.9 * l_->font}, "distance along the section", VTK_TEXT_CENTERED);
    text({l_->font, 0.5 * (top + bottom)}, "z", VTK_TEXT_CENTERED, 1.0);
    const std::string exaggeration = "vertical exaggeration " + tickText(l_->exaggeration, 0.1 * roundDown125(l_->exaggeration));
    text({middle, y(1.2 * l_->font)}, d_->title.empty() ? exaggeration : d_->title + "   (" + exaggeration + ")", VTK_TEXT_CENTERED, 1.15);
    text({l_->left, y(3.1 * l_->font)}, d_->start, VTK_TEXT_LEFT, 0.85);
    text({right, y(3.1 * l_->font)}, d_->end, VTK_TEXT_RIGHT, 0.85);
  }

  void legend() {
    const double left = l_->left + l_->width + l_->font;
    double at = y(l_->top);
    for (const LegendEntry& entry : legendOf(*d_)) {
      if (entry.is_line) {
        line({left, at - 0.5 * l_->font}, {left + 1.6 * l_->font, at - 0.5 * l_->font}, entry.color, 0.16 * l_->font);
      } else {
        brush(entry.color);
        painter_->DrawRect(static_cast<float>(left), static_cast<float>(at - l_->font), static_cast<float>(1.6 * l_->font), static_cast<float>(l_->font));
      }
      text({left + 2.1 * l_->font, at - 0.5 * l_->font}, entry.text, VTK_TEXT_LEFT, 0.9);
      at -= 1.6 * l_->font;
    }
  }

  const SectionDrawing* d_ = nullptr;
  const SectionLayout* l_ = nullptr;
  vtkContext2D* painter_ = nullptr;
};

vtkStandardNewMacro(SectionItem)

} // namespace

void renderSectionDrawing(const Offscreen& screen, const std::string& png, const SectionDrawing& drawing) {
  if (!screen.available())
    throw Error("drawing a section", screen.reason());
  checkPictureSize(drawing.width, drawing.height);
  const SectionLayout layout = layOut(drawing);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkRenderWindow> window;
  window->SetDisplayId(screen.connection());
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetSize(drawing.width, drawing.height);
  window->AddRenderer(paper);
  vtkNew<SectionItem> item;
  item->show(drawing, layout);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  paper->AddActor(actor);
  writePicture(window, png);
}

} // namespace graben
