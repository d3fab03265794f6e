#include "framework/app/plot/canvas.h"

#include <cairo-svg.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dvrlab {
namespace {

constexpr double pixels_per_unit = 2;  // of a PNG, for sharp text

void require(cairo_status_t status, const std::string& file) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(file + ": cannot be drawn: " + cairo_status_to_string(status));
}

cairo_surface_t* surface_of(const std::string& file, bool png, double width, double height) {
  if (!png) return cairo_svg_surface_create(file.c_str(), width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width * pixels_per_unit)),
                                    static_cast<int>(std::ceil(height * pixels_per_unit)));
}

}  // namespace

Canvas::Canvas(const std::string& file, Format format, double width, double height)
    : file_(file),
      png_(format == Format::png),
      surface_(surface_of(file, png_, width, height), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
  require(cairo_surface_status(surface_.get()), file);
  if (png_) cairo_scale(context_.get(), pixels_per_unit, pixels_per_unit);
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  rectangle(0, 0, width, height, {1, 1, 1});
}

void Canvas::finish() {
  require(cairo_status(context_.get()), file_);
  context_.reset();
  if (png_) require(cairo_surface_write_to_png(surface_.get(), file_.c_str()), file_);
  cairo_surface_finish(surface_.get());
  require(cairo_surface_status(surface_.get()), file_);
}

void Canvas::rectangles(const std::vector<Box>& boxes, const Rgba& fill) {
  set(fill);
  for (const Box& b : boxes) cairo_rectangle(context_.get(), b.x, b.y, b.width, b.height);
  cairo_fill(context_.get());
}

void Canvas::polyline(const std::vector<std::array<double, 2>>& points, const Rgba& stroke, double thickness) {
  set(stroke);
  cairo_set_line_width(context_.get(), thickness);
  for (const auto& p : points) cairo_line_to(context_.get(), p[0], p[1]);
  cairo_stroke(context_.get());
}

void Canvas::frame(double x, double y, double width, double height, const Rgba& stroke) {
  set(stroke);
  cairo_set_line_width(context_.get(), 1);
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_stroke(context_.get());
}

void Canvas::line(double x0, double y0, double x1, double y1, const Rgba& stroke, double thickness) {
  set(stroke);
  cairo_set_line_width(context_.get(), thickness);
  cairo_move_to(context_.get(), x0, y0);
  cairo_line_to(context_.get(), x1, y1);
  cairo_stroke(context_.get());
}

void Canvas::disc(double x, double y, double radius, const Rgba& fill) {
  set(fill);
  cairo_arc(context_.get(), x, y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(context_.get());
}

void Canvas::text(double x, double y, const std::string& words, double size, Align align, const Rgba& fill) {
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), words.c_str(), &extents);
  const double shift = align == Align::left ? 0 : align == Align::centre ? extents.x_advance / 2 : extents.x_advance;
  set(fill);
  cairo_move_to(context_.get(), x - shift, y);
  cairo_show_text(context_.get(), words.c_str());
}

}  // namespace dvrlab
