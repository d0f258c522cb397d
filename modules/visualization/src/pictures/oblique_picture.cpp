#include "graben/visualization/oblique_picture.h"

#include "drawing/clipped_mesh.h"
#include "drawing/plot.h"
#include "drawing/raster.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/normals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr const char* kStage = "drawing an oblique view";
constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr double kFaultOpacity = 0.32;
constexpr double kReliefShare = 0.25; // of the width: how high the relief is drawn

class ObliqueDrawing {
public:
  ObliqueDrawing(const ObliqueScene& scene, const ObliqueOptions& options)
    : scene_(scene), options_(options), canvas_(options.width, options.height) {
    validate(*scene.mesh, kStage, options.threads);
    for (const Triangle& t : scene.mesh->triangles)
      for (const Index v : t)
        box_.extend(scene.mesh->vertices[static_cast<std::size_t>(v)]);
    if (box_.empty())
      throw InvalidInputError(kStage, "there is nothing to draw");
    chooseExaggeration();
    const double a = options.azimuth * kRadians, e = options.elevation * kRadians;
    to_viewer_ = {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
    up_ = {-std::sin(a) * std::sin(e), -std::cos(a) * std::sin(e), std::cos(e)};
    right_ = up_.cross(to_viewer_);
    place();
  }

  void draw(const std::string& stem) {
    Raster raster(static_cast<int>(frame_.width), static_cast<int>(frame_.height));
    drawSurface(raster);
    drawFaults(raster);
    canvas_.image(raster.pixels(), frame_);
    drawMargin();
    canvas_.write(stem, options_.formats);
  }

private:
  void chooseExaggeration() {
    const Vector3 size = box_.size();
    exaggeration_ = options_.vertical_exaggeration;
    if (exaggeration_ > 0.0)
      return;
    const double factor = size.z() > 0.0 ? kReliefShare * std::max(size.x(), size.y()) / size.z() : 1.0;
    exaggeration_ = factor > 1.0 ? roundDown125(std::min(factor, 1e6)) : factor > 0.0 ? factor : 1.0;
  }

  /// With z up, exaggerated, about the middle.
  Vector3 toScene(const Vector3& p) const {
    Vector3 q = p - 0.5 * (box_.low + box_.high);
    q.z() *= options_.units.z_positive == ZPositive::Down ? -exaggeration_ : exaggeration_;
    return q;
  }

  Vector3 project(const Vector3& p) const {
    const Vector3 q = toScene(p);
    return {origin_.x() + scale_ * right_.dot(q), origin_.y() - scale_ * up_.dot(q), to_viewer_.dot(q)};
  }

  void place() {
    frame_ = {16.0, 52.0, options_.width - 16.0 - 200.0, options_.height - 52.0 - 24.0};
    Bounds seen;
    for (const Triangle& t : scene_.mesh->triangles)
      for (const Index v : t) {
        const Vector3 q = toScene(scene_.mesh->vertices[static_cast<std::size_t>(v)]);
        seen.extend(Vector3(right_.dot(q), up_.dot(q), 0.0));
      }
    const Vector3 size = seen.size();
    const double margin = 0.92;
    scale_ = margin * std::min(frame_.width / std::max(size.x(), 1e-9), frame_.height / std::max(size.y(), 1e-9));
    const Vector3 middle = 0.5 * (seen.low + seen.high);
    origin_ = {0.5 * frame_.width - scale_ * middle.x(), 0.5 * frame_.height + scale_ * middle.y()};
  }

  double shade(const Vector3& normal) const {
    const double z = options_.units.z_positive == ZPositive::Down ? -normal.z() : normal.z();
    Vector3 n = Vector3(normal.x() * exaggeration_, normal.y() * exaggeration_, z).normalized();
    if (n.z() < 0.0)
      n = -n;
    static const Vector3 light = Vector3(-1.0, 1.0, 1.4).normalized();
    return 0.62 + 0.40 * std::max(0.0, n.dot(light));
  }

  void drawSurface(Raster& raster) const {
    const TriangleMesh& mesh = *scene_.mesh;
    const double range = std::max(box_.size().z(), 1e-12);
    const bool down = options_.units.z_positive == ZPositive::Down;
    const auto triangle = [&](std::size_t i) {
      RasterTriangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(mesh.triangles[i][k]);
        t.corners[k] = project(mesh.vertices[v]);
        const double share = (mesh.vertices[v].z() - box_.low.z()) / range;
        t.colors[k] = ColorScale::height().at(down ? 1.0 - share : share);
        for (double& c : t.colors[k])
          c = std::min(1.0, c * (mesh.normals.empty() ? 1.0 : shade(mesh.normals[v])));
      }
      return t;
    };
    raster.draw(mesh.triangles.size(), triangle, 1.0, options_.threads);
  }

  void drawFaults(Raster& raster) const {
    const Bounds box = boxAroundSurface(*scene_.mesh);
    for (const TriangleMesh* whole : scene_.faults) {
      const TriangleMesh fault = clippedMesh(*whole, box);
      const auto triangle = [&](std::size_t i) {
        RasterTriangle t;
        const Vector3 normal = areaNormal(fault, fault.triangles[i]);
        for (std::size_t k = 0; k < 3; ++k) {
          t.corners[k] = project(fault.vertices[static_cast<std::size_t>(fault.triangles[i][k])]);
          t.colors[k] = kFault;
          for (double& c : t.colors[k])
            c *= normal.norm() > 0.0 ? shade(normal.normalized()) : 1.0;
        }
        return t;
      };
      raster.draw(fault.triangles.size(), triangle, kFaultOpacity, options_.threads);
    }
  }

  void drawMargin() {
    const double left = frame_.right() + 26.0;
    drawTitle(canvas_, options_.title, frame_.middle().x());
    drawNorth({left + 44.0, frame_.top + 40.0});
    const bool down = options_.units.z_positive == ZPositive::Down;
    const double high = std::max(box_.high.z(), box_.low.z() + 1e-9);
    drawColorBar(canvas_, {left, frame_.top + 130.0, 22.0, 320.0}, {ColorScale::height(), box_.low.z(), high, down, options_.units.heightTitle()});
    TextLook look{14.0};
    look.across = 0.0;
    canvas_.text({left, frame_.top + 480.0}, options_.units.exaggerationText(exaggeration_), look);
    const double length = roundDown125(130.0 / scale_);
    const double pixels = length * scale_;
    const double at = frame_.top + 520.0;
    canvas_.line({{left, at - 8.0}, {left, at}, {left + pixels, at}, {left + pixels, at - 8.0}}, {kDark, 1.5});
    look.up = 1.0;
    canvas_.text({left, at + 8.0}, tickText(length, length) + " " + options_.units.xy, look);
  }

  /// An arrow on the ground, as it is seen.
  void drawNorth(const Place& middle) {
    const auto ground = [&](double x, double y) {
      const Vector3 p(x, y, 0.0);
      return Place(middle + Place(right_.dot(p), -up_.dot(p)));
    };
    canvas_.area({ground(0.0, 34.0), ground(12.0, -24.0), ground(0.0, -12.0), ground(-12.0, -24.0)}, kDark);
    canvas_.text(ground(0.0, 52.0), "N", {15.0});
  }

  const ObliqueScene& scene_;
  const ObliqueOptions& options_;
  Canvas canvas_;
  Frame frame_;
  Bounds box_;
  Vector3 to_viewer_, up_, right_;
  Place origin_{0.0, 0.0};
  double scale_ = 1.0;
  double exaggeration_ = 1.0;
};

} // namespace

void drawOblique(const std::string& stem, const ObliqueScene& scene, const ObliqueOptions& options) {
  if (scene.mesh == nullptr)
    throw InvalidInputError(kStage, "there is nothing to draw");
  if (!std::isfinite(options.azimuth) || !(options.elevation >= 5.0 && options.elevation <= 90.0))
    throw InvalidInputError(kStage, "the viewer's azimuth must be finite and the elevation from 5 to 90 degrees");
  if (!(options.vertical_exaggeration >= 0.0 && std::isfinite(options.vertical_exaggeration)))
    throw InvalidInputError(kStage, "the vertical exaggeration must be 0 or positive");
  ObliqueDrawing(scene, options).draw(stem);
}

} // namespace graben
