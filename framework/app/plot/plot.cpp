#include "framework/app/plot/plot.h"

#include <algorithm>
#include <cmath>

#include "framework/app/plot/canvas.h"
#include "framework/image/atomic_file.h"
#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"

namespace dvrlab {
namespace {

constexpr double width = 640, left = 44, right = 16, plot_width = width - left - right;
constexpr double title_height = 26, histogram_height = 140, axis_height = 22, model_height = 20;
constexpr double caption_height = 16, curve_height = 44, strip_height = 14, gap = 10;
constexpr double bar_height = caption_height + curve_height + strip_height + gap;
constexpr std::size_t most_bars = 290;  // two pixels each
constexpr double small_text = 10, normal_text = 11;

using Align = Canvas::Align;

/// A step of 1, 2 or 5 times a power of ten: four to ten of them fit in the range.
double tick_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 4)));
  const double mantissa = range / 4 / power;
  return power * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

class PlotWriter {
 public:
  PlotWriter(const std::string& file, Canvas::Format format, const Plot& plot)
      : plot_(plot), canvas_(file, format, width, height_of(plot)) {}

  void write() {
    canvas_.text(left, y_ + 17, plot_.title, normal_text + 1);
    y_ += title_height;
    if (plot_.histogram) histogram();
    axis();
    for (const PlotModel& m : plot_.models) {
      if (!m.title.empty()) canvas_.text(left, y_ + 13, m.title, normal_text);
      if (!m.title.empty()) y_ += model_height;
      for (const TfBar& b : m.bars) bar(b);
    }
    canvas_.finish();
  }

 private:
  static double height_of(const Plot& plot) {
    double h = title_height + axis_height + gap + (plot.histogram ? histogram_height : 0);
    for (const PlotModel& m : plot.models)
      h += (m.title.empty() ? 0 : model_height) + bar_height * static_cast<double>(m.bars.size());
    return h;
  }

  double x_of(double value) const { return left + plot_width * (value - plot_.lo) / (plot_.hi - plot_.lo); }
  double value_of(double x) const { return plot_.lo + (plot_.hi - plot_.lo) * (x - left) / plot_width; }

  /// Bars as long as the logarithm of the count.
  void histogram() {
    const Histogram h = plot_.histogram->merged(most_bars);
    const double base = y_ + histogram_height;
    const double most = std::log10(1 + static_cast<double>(*std::max_element(h.count.begin(), h.count.end())));
    for (int decade = 1; decade <= static_cast<int>(most); ++decade) {
      const double y = base - histogram_height * decade / most;
      canvas_.line(left, y, left + plot_width, y, pale);
      canvas_.text(left - 4, y + 4, "1e" + std::to_string(decade), small_text, Align::right, grey);
    }
    std::vector<Canvas::Box> bars;
    for (std::size_t b = 0; b < h.count.size(); ++b) {
      const double v = plot_.slope * h.value(b) + plot_.intercept, half = std::abs(plot_.slope) * h.step / 2;
      const double x0 = std::max(x_of(v - half), left), x1 = std::min(x_of(v + half), left + plot_width);
      const double height = most > 0 ? histogram_height * std::log10(1 + static_cast<double>(h.count[b])) / most : 0;
      if (x1 > x0) bars.push_back({x0, base - height, x1 - x0, height});
    }
    canvas_.rectangles(bars, {0.42, 0.5, 0.6});
    y_ = base;
  }

  void axis() {
    canvas_.line(left, y_, left + plot_width, y_, ink);
    const double step = tick_step(plot_.hi - plot_.lo);
    for (double k = std::ceil(plot_.lo / step); k * step <= plot_.hi + 1e-9 * step; ++k) {
      const double x = x_of(k * step);
      canvas_.line(x, y_, x, y_ + 4, ink);
      canvas_.text(x, y_ + 15, number_text(k * step, 6), small_text, Align::centre);
    }
    y_ += axis_height;
  }

  /// The amount as a curve with its nodes, over a strip with the colour and, as alpha, the amount.
  void bar(const TfBar& b) {
    const auto shown = [&](double v) { return v >= plot_.lo && v <= plot_.hi; };
    const auto hidden =
        std::count_if(b.spikes.begin(), b.spikes.end(), [&](const TfSpike& s) { return !shown(s.value); });
    canvas_.text(left, y_ + 11,
                 b.title + (hidden > 0 ? " (" + std::to_string(hidden) + " beyond the data's values)" : ""),
                 small_text);
    y_ += caption_height;
    const double base = y_ + curve_height;
    const auto height = [&](double amount) { return curve_height * amount / b.top; };
    canvas_.text(left - 4, y_ + 8, number_text(b.top, 3), small_text, Align::right, grey);
    canvas_.text(left - 4, base, "0", small_text, Align::right, grey);
    checkerboard(base);
    strip(b, base);
    for (std::size_t channel = 0; channel < (b.amount.components == 1 ? 1u : 3u); ++channel) {
      std::vector<std::array<double, 2>> curve;
      for (double x = left; x <= left + plot_width; x += 0.5)
        curve.push_back({x, base - height(amount_at(b, value_of(x))[channel])});
      const Rgba stroke = b.amount.components == 1
                              ? ink
                              : Rgba{channel == 0 ? 0.8 : 0.0, channel == 1 ? 0.6 : 0.0, channel == 2 ? 0.8 : 0.0};
      canvas_.polyline(curve, stroke, 1.2);
    }
    for (const Node& n : b.amount.node)
      if (shown(n.value)) canvas_.disc(x_of(n.value), base - height(n.x[0]), 2.4, ink);
    for (const TfSpike& s : b.spikes) {
      if (!shown(s.value)) continue;
      const double x = x_of(s.value), top = base - height(s.opacity);
      canvas_.line(x, base + strip_height, x, top, ink, 3.4);
      canvas_.line(x, base + strip_height - 0.7, x, top + 0.7, {s.color[0], s.color[1], s.color[2]}, 2);
      canvas_.disc(x, top, 4, ink);
      canvas_.disc(x, top, 3, {s.color[0], s.color[1], s.color[2]});
    }
    canvas_.frame(left, y_, plot_width, curve_height + strip_height, grey);
    y_ += curve_height + strip_height + gap;
  }

  /// The colour, with the amount as its alpha; runs of one colour in 8 bits are one box.
  void strip(const TfBar& b, double y) {
    std::array<int, 4> run{};
    double start = left;
    const auto draw = [&](double end) {
      const auto unit = [&](std::size_t k) { return run[k] / 255.0; };
      if (run[3] > 0) canvas_.rectangle(start, y, end - start, strip_height, {unit(0), unit(1), unit(2), unit(3)});
      start = end;
    };
    for (double x = left; x < left + plot_width; ++x) {
      const double v = value_of(x + 0.5);
      const Vector3 a = amount_at(b, v), c = color_at(b, v);
      const auto byte = [](double t) { return static_cast<int>(std::lround(255 * std::clamp(t, 0.0, 1.0))); };
      const std::array<int, 4> here{byte(c[0]), byte(c[1]), byte(c[2]), byte(std::max({a[0], a[1], a[2]}) / b.top)};
      if (here == run) continue;
      draw(x);
      run = here;
    }
    draw(left + plot_width);
  }

  /// Under what is transparent.
  void checkerboard(double y) {
    const double side = strip_height / 2;
    std::vector<Canvas::Box> squares;
    for (int row = 0; row < 2; ++row)
      for (int k = row; k * side < plot_width; k += 2)
        squares.push_back({left + k * side, y + row * side, std::min(side, plot_width - k * side), side});
    canvas_.rectangles(squares, pale);
  }

  const Plot& plot_;
  Canvas canvas_;
  double y_ = 0;
};

}  // namespace

void check_plot_name(const std::string& file) {
  if (!file.ends_with(".svg") && !file.ends_with(".png"))
    throw InputError("--plot " + file + ": is no plot's name; it must end in .svg or .png");
}

void write_plot(const std::string& file, const Plot& plot) {
  check_plot_name(file);
  const auto format = file.ends_with(".png") ? Canvas::Format::png : Canvas::Format::svg;
  write_atomically(file, [&](const std::string& name) { PlotWriter(name, format, plot).write(); });
}

}  // namespace dvrlab
