// A drawing surface of the Cairo library, with the few shapes that plots need. Lengths are pixels, y grows downwards.
#pragma once

#include <cairo.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace dvrlab {

struct Rgba {
  double r, g, b, a = 1;
};
inline constexpr Rgba ink{0.1, 0.1, 0.1}, grey{0.55, 0.55, 0.55}, pale{0.85, 0.85, 0.85};

class Canvas {
 public:
  enum class Align { left, centre, right };

  enum class Format { svg, png };

  /// Throws std::runtime_error when the library refuses.
  Canvas(const std::string& file, Format format, double width, double height);
  /// Writes the file.
  void finish();

  struct Box {
    double x, y, width, height;
  };
  void rectangle(double x, double y, double width, double height, const Rgba& fill) {
    rectangles({{x, y, width, height}}, fill);
  }
  /// All as one shape of the file.
  void rectangles(const std::vector<Box>& boxes, const Rgba& fill);
  void frame(double x, double y, double width, double height, const Rgba& stroke);
  void line(double x0, double y0, double x1, double y1, const Rgba& stroke, double thickness = 1);
  void polyline(const std::vector<std::array<double, 2>>& points, const Rgba& stroke, double thickness);
  void disc(double x, double y, double radius, const Rgba& fill);
  /// (x, y): the text's base line.
  void text(double x, double y, const std::string& words, double size, Align align = Align::left,
            const Rgba& fill = ink);

 private:
  void set(const Rgba& c) const { cairo_set_source_rgba(context_.get(), c.r, c.g, c.b, c.a); }

  std::string file_;
  bool png_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace dvrlab
