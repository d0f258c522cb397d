#include "drawing/canvas.h"

#include "drawing/picture_file.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <cmath>
#include <new>

#include <sys/mman.h>

namespace graben {

namespace {

constexpr double kPi = 3.14159265358979323846;

cairo_status_t append(void* into, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(into)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void setColor(cairo_t* to, const Color& c, double opacity) { cairo_set_source_rgba(to, c[0], c[1], c[2], opacity); }

void trace(cairo_t* to, const std::vector<Place>& places) {
  bool first = true;
  for (const Place& p : places) {
    first ? cairo_move_to(to, p.x(), p.y()) : cairo_line_to(to, p.x(), p.y());
    first = false;
  }
}

void setPen(cairo_t* to, const Pen& pen) {
  setColor(to, pen.color, pen.opacity);
  cairo_set_line_width(to, pen.width);
  cairo_set_dash(to, pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0.0);
}

void setFont(cairo_t* to, const TextLook& look) {
  cairo_select_font_face(to, "sans-serif", CAIRO_FONT_SLANT_NORMAL, look.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, look.size);
}

/// cairo crashes where memory gives out, so what a picture may take must be free before it is drawn.
/// \throw std::bad_alloc if it is not
void requireMemory(int width, int height) {
  constexpr std::size_t usual = std::size_t{24} << 20;
  constexpr std::size_t per_pixel = 8;
  const std::size_t bytes = usual + per_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  void* room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
    throw std::bad_alloc();
  ::munmap(room, bytes);
}

} // namespace

struct Canvas::State {
  State(int width, int height) {
    const cairo_rectangle_t extents{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)};
    record = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents);
    context = cairo_create(record);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_font_options_t* options = cairo_font_options_create(); // the same letters on every machine and at every size
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
  }
  ~State() {
    cairo_destroy(context);
    cairo_surface_destroy(record);
  }

  void play(cairo_surface_t* surface) const {
    cairo_t* to = cairo_create(surface);
    cairo_set_source_surface(to, record, 0.0, 0.0);
    cairo_paint(to);
    cairo_destroy(to);
  }

  cairo_surface_t* record;
  cairo_t* context;
};

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
  checkPictureSize(width, height);
  requireMemory(width, height);
  state_ = std::make_unique<State>(width, height);
  box({0.0, 0.0, static_cast<double>(width), static_cast<double>(height)}, kWhite);
}

Canvas::~Canvas() = default;

void Canvas::line(const std::vector<Place>& places, const Pen& pen, bool closed) {
  cairo_t* to = state_->context;
  setPen(to, pen);
  trace(to, places);
  if (closed)
    cairo_close_path(to);
  cairo_stroke(to);
}

void Canvas::lines(const std::vector<std::vector<Place>>& lines, const Pen& pen) {
  cairo_t* to = state_->context;
  setPen(to, pen);
  for (const std::vector<Place>& places : lines)
    trace(to, places);
  cairo_stroke(to);
}

void Canvas::area(const std::vector<Place>& ring, const Color& color, double opacity) {
  setColor(state_->context, color, opacity);
  trace(state_->context, ring);
  cairo_close_path(state_->context);
  cairo_fill(state_->context);
}

void Canvas::area(const std::vector<std::vector<Place>>& rings, const Color& color) {
  cairo_t* to = state_->context;
  setColor(to, color, 1.0);
  cairo_new_path(to);
  for (const std::vector<Place>& ring : rings) {
    cairo_new_sub_path(to);
    for (const Place& place : ring)
      cairo_line_to(to, place.x(), place.y());
    cairo_close_path(to);
  }
  cairo_set_fill_rule(to, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(to);
  cairo_set_fill_rule(to, CAIRO_FILL_RULE_WINDING);
}

void Canvas::box(const Frame& frame, const Color& color, double opacity) {
  setColor(state_->context, color, opacity);
  cairo_rectangle(state_->context, frame.left, frame.top, frame.width, frame.height);
  cairo_fill(state_->context);
}

void Canvas::hatch(const std::vector<Place>& ring, const Pen& pen, double distance) {
  if (ring.size() < 3)
    return;
  cairo_t* to = state_->context;
  cairo_save(to);
  trace(to, ring);
  cairo_close_path(to);
  cairo_clip(to);
  double low = ring[0].x() - ring[0].y(), high = low, top = ring[0].y(), bottom = top;
  for (const Place& p : ring) {
    low = std::min(low, p.x() - p.y());
    high = std::max(high, p.x() - p.y());
    top = std::min(top, p.y());
    bottom = std::max(bottom, p.y());
  }
  setPen(to, pen);
  for (double at = std::ceil(low / distance) * distance; at <= high; at += distance) {
    cairo_move_to(to, at + top, top);
    cairo_line_to(to, at + bottom, bottom);
  }
  cairo_stroke(to);
  cairo_restore(to);
}

void Canvas::dots(const std::vector<Place>& places, double radius, const Color& color, double opacity) {
  cairo_t* to = state_->context;
  setColor(to, color, opacity);
  for (const Place& p : places) {
    cairo_new_sub_path(to);
    cairo_arc(to, p.x(), p.y(), radius, 0.0, 2.0 * kPi);
  }
  cairo_fill(to);
}

Place Canvas::textSize(const std::string& text, const TextLook& look) const {
  setFont(state_->context, look);
  cairo_text_extents_t extents;
  cairo_text_extents(state_->context, text.c_str(), &extents);
  return {extents.x_advance, 0.73 * look.size};
}

void Canvas::text(const Place& at, const std::string& text, const TextLook& look) {
  cairo_t* to = state_->context;
  const Place size = textSize(text, look);
  cairo_save(to);
  cairo_translate(to, at.x(), at.y());
  cairo_rotate(to, look.turn);
  const double x = -look.across * size.x();
  const double y = look.up * size.y();
  if (look.halo) {
    cairo_move_to(to, x, y);
    cairo_text_path(to, text.c_str());
    setPen(to, {kWhite, 0.22 * look.size, 0.85});
    cairo_stroke(to);
  }
  setColor(to, look.color, 1.0);
  cairo_move_to(to, x, y);
  cairo_show_text(to, text.c_str());
  cairo_restore(to);
}

void Canvas::image(const Pixels& pixels, const Frame& frame) {
  if (pixels.values.empty())
    return;
  const cairo_format_t format = pixels.transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24;
  requireMemory(pixels.width, pixels.height);
  cairo_surface_t* surface = cairo_image_surface_create(format, pixels.width, pixels.height);
  unsigned char* data = cairo_image_surface_get_data(surface);
  if (data == nullptr) {
    cairo_surface_destroy(surface);
    throw std::bad_alloc();
  }
  const int stride = cairo_image_surface_get_stride(surface);
  for (int row = 0; row < pixels.height; ++row)
    std::copy_n(&pixels.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.width)], pixels.width,
                reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(row) * stride));
  cairo_surface_mark_dirty(surface);
  cairo_t* to = state_->context;
  cairo_save(to);
  cairo_translate(to, frame.left, frame.top);
  cairo_scale(to, frame.width / pixels.width, frame.height / pixels.height);
  cairo_set_source_surface(to, surface, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(to), pixels.width == static_cast<int>(frame.width) ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(to), CAIRO_EXTEND_PAD);
  cairo_rectangle(to, 0.0, 0.0, pixels.width, pixels.height);
  cairo_fill(to);
  cairo_restore(to);
  cairo_surface_destroy(surface);
}

void Canvas::clip(const Frame& frame) {
  cairo_save(state_->context);
  cairo_rectangle(state_->context, frame.left, frame.top, frame.width, frame.height);
  cairo_clip(state_->context);
}

void Canvas::unclip() { cairo_restore(state_->context); }

void Canvas::write(const std::string& stem, const PictureFormats& formats) const {
  requireMemory(width_, height_);
  const auto finish = [](cairo_surface_t* surface) {
    cairo_surface_finish(surface);
    const cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (status != CAIRO_STATUS_SUCCESS)
      throw Error("drawing a picture", cairo_status_to_string(status));
  };
  if (formats.png) {
    std::string bytes;
    cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_);
    state_->play(surface);
    cairo_surface_write_to_png_stream(surface, append, &bytes);
    finish(surface);
    writeFile(stem + ".png", bytes);
  }
  if (formats.svg) {
    std::string bytes;
    cairo_surface_t* surface = cairo_svg_surface_create_for_stream(append, &bytes, width_, height_);
    state_->play(surface);
    finish(surface);
    writeFile(stem + ".svg", bytes);
  }
  if (formats.pdf) {
    std::string bytes;
    cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append, &bytes, width_, height_);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z"); // the same bytes for the same picture
    state_->play(surface);
    finish(surface);
    writeFile(stem + ".pdf", bytes);
  }
}

} // namespace graben
