#include "graben/visualization/render.h"

#include "drawing/picture_file.h"
#include "scenes/annotations.h"
#include "scenes/scene_actors.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"

#include <Eigen/Geometry>

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace graben {
namespace {

constexpr const char* kStage = "drawing the surface";
constexpr std::array<double, 4> kPlotArea{0.01, 0.09, 0.87, 0.94}; // left, bottom, right, top of the window

/// What of the scene is looked at, worked out before anything is drawn.
struct Shown {
  std::vector<Triangle> triangles;
  Bounds bounds;    ///< of what is looked at, user's frame
  Bounds margin;    ///< those bounds with some room, where faults are cut off
  Points content;   ///< points that must be inside the picture, user's frame
};

bool inside(const Bounds& box, const Vector3& p) {
  return (p.head<2>().array() >= box.low.head<2>().array()).all() &&
         (p.head<2>().array() <= box.high.head<2>().array()).all();
}

Bounds everywhere() {
  constexpr double kFar = std::numeric_limits<double>::max();
  return {Vector3::Constant(-kFar), Vector3::Constant(kFar)};
}

void addPoints(const Points& points, const Bounds& region, Shown& shown) {
  for (const Vector3& p : points)
    if (p.allFinite() && inside(region, p))
      shown.content.push_back(p);
}

void addMesh(const TriangleMesh& mesh, const Bounds& region, Shown& shown) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    Bounds box;
    for (const Index v : t)
      box.extend(mesh.vertices[static_cast<std::size_t>(v)]);
    box.low.z() = region.low.z();
    box.high.z() = region.high.z();
    if (!box.overlaps(region))
      continue;
    shown.triangles.push_back(t);
    for (const Index v : t)
      used[static_cast<std::size_t>(v)] = 1;
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0)
      shown.content.push_back(mesh.vertices[i]);
}

/// Triangles reach out of the zoom box and are cut off there, so the box itself is what must be seen.
void keepInside(const Bounds& zoom, Shown& shown) {
  shown.bounds.low.head<2>() = shown.bounds.low.head<2>().cwiseMax(zoom.low.head<2>());
  shown.bounds.high.head<2>() = shown.bounds.high.head<2>().cwiseMin(zoom.high.head<2>());
  shown.content.clear();
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 p = shown.bounds.low;
    for (int axis = 0; axis < 3; ++axis)
      if ((corner >> axis & 1) != 0)
        p[axis] = shown.bounds.high[axis];
    shown.content.push_back(p);
  }
}

Shown chooseContent(const SurfaceScene& scene, const RenderOptions& options) {
  Shown shown;
  const Bounds region = options.zoom ? *options.zoom : everywhere();
  if (scene.mesh != nullptr)
    addMesh(*scene.mesh, region, shown);
  if (scene.picks != nullptr)
    addPoints(*scene.picks, region, shown);
  if (shown.content.empty()) {
    for (const TriangleMesh* fault : scene.faults)
      addPoints(fault->vertices, region, shown);
    for (const Points& line : scene.polylines)
      addPoints(line, region, shown);
  }
  shown.bounds = boundsOf(shown.content);
  if (shown.bounds.empty())
    throw InvalidInputError(kStage, options.zoom ? "nothing lies inside the zoom box" : "there is nothing to draw");
  if (options.zoom)
    keepInside(*options.zoom, shown);
  Vector3 margin = 0.05 * shown.bounds.size();
  margin.z() = 0.2 * shown.bounds.size().z();
  margin = margin.cwiseMax(1e-3 * shown.bounds.diagonal());
  shown.margin = {shown.bounds.low - margin, shown.bounds.high + margin};
  return shown;
}

/// Exaggeration at which the relief is about a quarter as high as the surface is wide.
double chooseExaggeration(const Bounds& bounds, double asked) {
  if (asked > 0.0)
    return asked;
  const Vector3 size = bounds.size();
  const double wide = std::max(size.x(), size.y());
  const double factor = size.z() > 0.0 ? 0.25 * wide / size.z() : 1.0;
  return factor > 1.0 ? roundDown125(std::min(factor, 1e6)) : 1.0;
}

void checkOptions(const Offscreen& screen, const SurfaceScene& scene, const RenderOptions& options) {
  if (!screen.available())
    throw Error(kStage, screen.reason());
  checkPictureSize(options.width, options.height);
  if (scene.mesh != nullptr)
    validate(*scene.mesh, kStage);
  for (const TriangleMesh* fault : scene.faults)
    validate(*fault, kStage);
  const View& view = options.view;
  if (!std::isfinite(view.azimuth) || !(std::abs(view.elevation) <= 90.0))
    throw InvalidInputError(kStage, "the view's azimuth must be finite and its elevation from -90 to 90 degrees");
  if (!(options.vertical_exaggeration >= 0.0 && std::isfinite(options.vertical_exaggeration)))
    throw InvalidInputError(kStage, "the vertical exaggeration must be 0 or positive");
  if (scene.mesh == nullptr)
    return;
  if (options.color_by == ColorBy::Piece && scene.mesh->piece.empty())
    throw InvalidInputError(kStage, "the mesh has no pieces to colour by");
  if (options.color_by == ColorBy::Scalar && scene.mesh->scalars.count(options.scalar) == 0)
    throw InvalidInputError(kStage, "the mesh has no scalar named '" + options.scalar + "' to colour by");
}

ValueColors chooseColors(const TriangleMesh& mesh, const Shown& shown, const RenderOptions& options) {
  ValueColors colors;
  if (options.color_by == ColorBy::Scalar) {
    colors.values = mesh.scalars.at(options.scalar);
  } else {
    colors.reversed = options.z_positive == ZPositive::Down;
    for (const Vector3& p : mesh.vertices)
      colors.values.push_back(static_cast<float>(p.z()));
  }
  Bounds range; // x only
  for (const Triangle& t : shown.triangles)
    for (const Index v : t) {
      const double value = colors.values[static_cast<std::size_t>(v)];
      if (std::isfinite(value))
        range.extend(Vector3(value, 0.0, 0.0));
    }
  colors.low = range.empty() ? 0.0 : range.low.x();
  colors.high = range.empty() ? 1.0 : range.high.x();
  if (!(colors.high > colors.low))
    colors.high = colors.low + std::max(1e-6, 1e-6 * std::abs(colors.low));
  else if (options.color_by == ColorBy::Elevation)
    colors.contours = niceTicks(colors.low, colors.high, 20);
  return colors;
}

/// Axes of the picture in the scene.
struct Axes {
  Vector3 right, up, to_viewer;

  explicit Axes(const View& view) {
    constexpr double kRadians = 3.14159265358979323846 / 180.0;
    const double sin_a = std::sin(view.azimuth * kRadians), cos_a = std::cos(view.azimuth * kRadians);
    const double sin_e = std::sin(view.elevation * kRadians), cos_e = std::cos(view.elevation * kRadians);
    to_viewer = {sin_a * cos_e, cos_a * cos_e, sin_e};
    up = {-sin_a * sin_e, -cos_a * sin_e, cos_e};
    right = up.cross(to_viewer);
  }
};

/// How the scene becomes a picture.
struct Picture {
  const RenderOptions& options;
  SceneSpace space;
  Axes axes;
  double lift; ///< how far lines and dots are moved towards the viewer, so that they do not drown in the surface they lie on

  vtkSmartPointer<vtkActor> lifted(vtkSmartPointer<vtkActor> actor) const {
    const Vector3 by = lift * axes.to_viewer; // does not show: the projection is parallel
    actor->SetPosition(by.x(), by.y(), by.z());
    return actor;
  }
};

/// Points the camera so that all content fits. \return size of a pixel in scene units
double frame(vtkRenderer* plot, const Shown& shown, const Picture& picture) {
  const auto& [options, space, axes, lift] = picture;
  Bounds seen; // right, up, towards the viewer
  for (const Vector3& p : shown.content) {
    const Vector3 q = space.toScene(p);
    seen.extend(Vector3(axes.right.dot(q), axes.up.dot(q), axes.to_viewer.dot(q)));
  }
  const double pixels_wide = (kPlotArea[2] - kPlotArea[0]) * options.width;
  const double pixels_high = (kPlotArea[3] - kPlotArea[1]) * options.height;
  const Vector3 size = seen.size();
  double half_height = 0.52 * std::max(size.y(), size.x() * pixels_high / pixels_wide);
  if (!(half_height > 0.0))
    half_height = 1.0;
  const Vector3 middle = 0.5 * (seen.low + seen.high);
  const Vector3 target = middle.x() * axes.right + middle.y() * axes.up + middle.z() * axes.to_viewer;
  const Vector3 eye = target + (2.0 * size.norm() + half_height + lift) * axes.to_viewer;
  vtkCamera* camera = plot->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(target.x(), target.y(), target.z());
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(axes.up.x(), axes.up.y(), axes.up.z());
  camera->SetParallelScale(half_height);
  plot->ResetCameraClippingRange();
  return 2.0 * half_height / pixels_high;
}

/// From the upper left, as maps are shaded, and some from the viewer.
void addLights(vtkRenderer* plot) {
  struct Lamp {
    double x, y, z, intensity;
  };
  plot->AutomaticLightCreationOff();
  for (const Lamp lamp : {Lamp{-1.0, 1.0, 1.0, 0.65}, Lamp{0.0, 0.0, 1.0, 0.5}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(lamp.x, lamp.y, lamp.z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(lamp.intensity);
    plot->AddLight(light);
  }
}

void addSurface(vtkRenderer* plot, Annotations& notes, const TriangleMesh& mesh, const Shown& shown,
                const Picture& picture) {
  const RenderOptions& options = picture.options;
  DrawnMesh drawn{mesh, shown.triangles, std::nullopt};
  if (options.zoom) { // with room in z: a level surface must not lie on the edge of the box
    drawn.crop = shown.margin;
    drawn.crop->low.head<2>() = shown.bounds.low.head<2>();
    drawn.crop->high.head<2>() = shown.bounds.high.head<2>();
  }
  if (options.color_by == ColorBy::Piece) {
    plot->AddActor(surfaceActor(drawn, picture.space, nullptr, options.edges));
    drawPieceLegend(notes, *std::max_element(mesh.piece.begin(), mesh.piece.end()) + 1, options.piece_names);
    return;
  }
  const ValueColors colors = chooseColors(mesh, shown, options);
  plot->AddActor(surfaceActor(drawn, picture.space, &colors, options.edges));
  if (!colors.contours.empty())
    plot->AddActor(picture.lifted(contourActor(drawn, picture.space, colors)));
  drawValueLegend(notes, *elevationColors(colors.low, colors.high, colors.reversed), colors.reversed,
                  options.color_by == ColorBy::Scalar ? options.scalar : "z");
}

void addActors(vtkRenderer* plot, Annotations& notes, const SurfaceScene& scene, const Shown& shown,
               const Picture& picture) {
  const double stroke = notes.fontSize() / 25.0;
  if (scene.mesh != nullptr && !shown.triangles.empty())
    addSurface(plot, notes, *scene.mesh, shown, picture);
  for (const TriangleMesh* fault : scene.faults)
    plot->AddActor(faultActor({*fault, fault->triangles, shown.margin}, picture.space));
  if (scene.picks != nullptr)
    plot->AddActor(picture.lifted(
        pickActor(*scene.picks, scene.pick_piece, picture.space, shown.margin, std::max(2.0, 2.5 * stroke))));
  for (const Points& line : scene.polylines)
    plot->AddActor(picture.lifted(lineActor(line, picture.space, 3.0 * stroke)));
}

} // namespace

void renderSurface(const Offscreen& screen, const std::string& png, const SurfaceScene& scene,
                   const RenderOptions& options) {
  checkOptions(screen, scene, options);
  const Shown shown = chooseContent(scene, options);
  const double exaggeration = chooseExaggeration(shown.bounds, options.vertical_exaggeration);
  SceneSpace space;
  space.centre = 0.5 * (shown.bounds.low + shown.bounds.high);
  space.z_factor = options.z_positive == ZPositive::Down ? -exaggeration : exaggeration;

  vtkNew<vtkRenderer> plot;
  plot->SetViewport(kPlotArea[0], kPlotArea[1], kPlotArea[2], kPlotArea[3]);
  plot->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkRenderer> paper; // the white margin
  paper->SetBackground(1.0, 1.0, 1.0);
  Annotations notes(options.width, options.height);
  addLights(plot);
  const Picture picture{options, space, Axes(options.view),
                        2e-3 * (space.toScene(shown.bounds.high) - space.toScene(shown.bounds.low)).norm()};
  addActors(plot, notes, scene, shown, picture);
  const double units_per_pixel = frame(plot, shown, picture);
  drawScaleBar(notes, units_per_pixel);
  drawNorth(notes, picture.axes.right.y(), picture.axes.up.y());
  notes.text(0.985 * options.width, 0.045 * options.height,
             exaggeration == 1.0 ? "no vertical exaggeration"
                                 : "vertical exaggeration " + tickText(exaggeration, roundDown125(exaggeration)),
             Annotations::Align::Right, 0.85);
  notes.text(0.02 * options.width, 0.967 * options.height, options.title, Annotations::Align::Left, 1.2);

  vtkNew<vtkRenderWindow> window;
  window->SetDisplayId(screen.connection());
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetSize(options.width, options.height);
  window->SetNumberOfLayers(2);
  window->AddRenderer(paper);
  window->AddRenderer(plot);
  window->AddRenderer(notes.renderer());
  writePicture(window, png);
}

} // namespace graben
