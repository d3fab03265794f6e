#include "framework/backend/light_sum.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

template <class Real>
using Numbers = std::shared_ptr<std::vector<Real>>;
const Numbers<float>& numbers_of(const LightVolume& v, float) { return v.values; }
const Numbers<double>& numbers_of(const LightVolume& v, double) { return v.values64; }

/// The volume that the march reads: the parts' light in the lights' colours, then bias and blend.
template <class Real>
void combine(const LightWork& work, const std::vector<std::vector<const LightVolume*>>& parts, int planes,
             std::vector<Real>& out) {
  const std::size_t points = out.size() / std::size_t(planes);
  const auto bias = static_cast<Real>(work.plan.bias), blend = static_cast<Real>(work.plan.blend);
  const Real one = 1;
  const auto combine_block = [&](std::uint64_t begin, std::uint64_t end, std::vector<std::array<Real, 3>>& sum) {
    sum.assign(end - begin, std::array<Real, 3>{});
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const LightPart& part = work.plan.parts[p];
      const int channels = part.error ? 1 : parts[p].front()->grid.channels, first = part.first_light;
      for (int c = 0; c < channels; ++c) {
        std::array<Real, 3> color{one, one, one};
        if (first >= 0)
          for (std::size_t k = 0; k < 3; ++k)
            color[k] = static_cast<Real>(work.color[std::size_t(work.rgb ? first : first + c)][k]);
        const int only = part.error ? part.color : work.rgb ? c : -1;
        if (only >= 0)
          for (std::size_t k = 0; k < 3; ++k) color[k] = k == std::size_t(only) ? color[k] : Real(0);
        for (std::uint64_t i = begin; i < end; ++i) {
          Real light = 0;
          for (const LightVolume* v : parts[p]) light += (*numbers_of(*v, Real()))[std::size_t(c) * points + i];
          if (part.clamp) light = std::min(std::max(light, Real(0)), one);
          for (std::size_t k = 0; k < 3; ++k) sum[i - begin][k] += color[k] * light;
        }
      }
    }
    for (std::uint64_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < std::size_t(planes); ++k)
        out[k * points + i] = (one - blend) + blend * (bias + (one - bias) * sum[i - begin][k]);
  };
  constexpr std::uint64_t block = 4096;  // its sums stay in the cache
  parallel_ranges(points, 65536, [&](std::uint64_t begin, std::uint64_t end) {
    std::vector<std::array<Real, 3>> sum;
    for (std::uint64_t i = begin; i < end; i += block) combine_block(i, std::min(i + block, end), sum);
  });
}

/// Light does not jump either where blocks of different levels meet.
template <class Real>
void conform_planes(const LightWork& work, std::vector<Real>& values) {
  if (work.blocks == nullptr) return;
  for (std::size_t at = 0; at < values.size(); at += work.blocks->samples) conform(*work.blocks, values.data() + at);
}

/// Standard error of combine()'s result, of the channels together; nothing where no part has one.
std::shared_ptr<std::vector<float>> combined_error(const LightWork& work,
                                                   const std::vector<std::vector<const LightVolume*>>& parts,
                                                   std::size_t points) {
  std::vector<double> square;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const LightPart& part = work.plan.parts[p];
    if (!part.error) continue;
    square.resize(points);
    const auto& color = work.color[std::size_t(part.first_light)];
    const double factor = work.plan.blend * (1 - work.plan.bias) * *std::max_element(color.begin(), color.end());
    for (std::size_t i = 0; i < points; ++i) {
      const double e = factor * static_cast<double>((*parts[p].front()->values)[points + i]);
      square[i] += e * e;
    }
  }
  if (square.empty()) return nullptr;
  auto error = std::make_shared<std::vector<float>>(points);
  std::transform(square.begin(), square.end(), error->begin(),
                 [](double x) { return static_cast<float>(std::sqrt(x)); });
  return error;
}

/// The image as the sum over stages of the mean of their independent estimates, and from those its standard error.
template <class Real>
void join_estimates(const FrameJob& job, const std::vector<const LightVolume*>& parts, FrameResult& result) {
  const std::size_t pixels = std::size_t(job.width) * std::size_t(job.height);
  FrameImage& image = result.image;
  image.width = job.width;
  image.height = job.height;
  image.color.resize(3 * pixels);
  image.trans.resize(3 * pixels);
  if (job.precision == Precision::fp64) {
    image.color64.resize(3 * pixels);
    image.trans64.resize(3 * pixels);
  }
  double square = 0, worst = 0;
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t ch = 0; ch < 4; ++ch) {
      double value = 0, variance = 0;
      for (const LightVolume* v : parts) {
        const auto batches = std::size_t(v->grid.dims[2]);
        double mean = 0, deviation = 0;
        for (std::size_t b = 0; b < batches; ++b) {
          const double x = double((*numbers_of(*v, Real()))[(ch * batches + b) * pixels + p]), d = x - mean;
          mean += d / double(b + 1);
          deviation += d * (x - mean);
        }
        value += mean;
        variance += deviation / double(batches * (batches - 1));
      }
      if (ch == 3) {
        std::fill_n(image.trans.begin() + std::ptrdiff_t(3 * p), 3, float(value));
        if (!image.trans64.empty()) std::fill_n(image.trans64.begin() + std::ptrdiff_t(3 * p), 3, value);
        continue;
      }
      image.color[3 * p + ch] = float(value);
      if (!image.color64.empty()) image.color64[3 * p + ch] = value;
      square += variance;
      worst = std::max(worst, variance);
    }
  result.light = {{"error_rms", std::sqrt(square / double(3 * pixels))}, {"error_max", std::sqrt(worst)}};
}

/// The values as levels of equal steps, and the values that those stand for.
template <class Real>
void store_as_levels(std::vector<Real>& values, LightVolume& v) {
  constexpr int most = 65535;
  const Real largest = *std::max_element(values.begin(), values.end());
  v.levels = std::make_shared<std::vector<std::uint16_t>>(values.size());
  v.unit = largest > 0 ? static_cast<float>(largest / most) : 1.0f;
  const auto unit = static_cast<Real>(v.unit);
  parallel_ranges(values.size(), 65536, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      const auto level = static_cast<int>(values[i] / unit + Real(0.5));
      (*v.levels)[i] = static_cast<std::uint16_t>(std::clamp(level, 0, most));
      values[i] = static_cast<Real>((*v.levels)[i]) * unit;
    }
  });
}

std::vector<std::pair<std::string, double>> statistics_of(const LightVolume& volume) {
  double sum = 0, square = 0, least = 1e300, most = -1e300;
  for (const float x : *volume.values) {
    sum += double(x);
    square += double(x) * double(x);
    least = std::min(least, double(x));
    most = std::max(most, double(x));
  }
  const auto count = double(volume.values->size());
  const double mean = sum / count;
  std::vector<std::pair<std::string, double>> values = {
      {"min", least},
      {"max", most},
      {"mean", mean},
      {"deviation", std::sqrt(std::max(square / count - mean * mean, 0.0))}};
  if (volume.error == nullptr) return values;
  square = most = 0;
  for (const float e : *volume.error) {
    square += double(e) * double(e);
    most = std::max(most, double(e));
  }
  values.insert(values.end(), {{"error_rms", std::sqrt(square / double(volume.error->size()))}, {"error_max", most}});
  return values;
}

}  // namespace

int light_planes(const LightWork& work) {
  const bool grey = std::all_of(work.color.begin(), work.color.end(),
                                [](const std::array<double, 3>& c) { return c[0] == c[1] && c[1] == c[2]; });
  return work.rgb || !grey ? 3 : 1;
}

LightVolume sum_of_light(const FrameJob& job, const std::vector<std::vector<const LightVolume*>>& parts) {
  const LightWork& work = *job.light;
  LightVolume v;
  v.grid = light_points(work.dims, work.blocks.get(), light_planes(work));
  v.values = std::make_shared<std::vector<float>>(v.grid.numbers());
  if (job.precision == Precision::fp64) {
    v.values64 = std::make_shared<std::vector<double>>(v.grid.numbers());
    combine(work, parts, v.grid.channels, *v.values64);
    conform_planes(work, *v.values64);
    if (work.plan.storage == LightStorage::unorm16) store_as_levels(*v.values64, v);
    std::transform(v.values64->begin(), v.values64->end(), v.values->begin(),
                   [](double x) { return static_cast<float>(x); });
  } else {
    combine(work, parts, v.grid.channels, *v.values);
    conform_planes(work, *v.values);
    if (work.plan.storage == LightStorage::unorm16) store_as_levels(*v.values, v);
  }
  v.error = combined_error(work, parts, std::size_t(v.grid.points()));
  v.statistics = statistics_of(v);
  return v;
}

void join_image(const FrameJob& job, const std::vector<const LightVolume*>& estimates, FrameResult& result) {
  if (job.precision == Precision::fp64)
    join_estimates<double>(job, estimates, result);
  else
    join_estimates<float>(job, estimates, result);
}

}  // namespace dvrlab
