#include "plugins/data/dicom/stack.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "framework/interfaces/error.h"

namespace dvrlab::dicom {
namespace {

// Files write positions with two to six digits of a millimetre, so that even slices look uneven by up to this share
// of their distance.
constexpr double uneven = 0.02;
constexpr double rounding = 1e-4;  // of unit vectors and pixel spacings, which have six digits

Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector3& a) { return std::sqrt(dot(a, a)); }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::string text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

std::string name_of(const Slice& s) { return s.frame == 0 ? s.file : s.file + " frame " + std::to_string(s.frame + 1); }

[[noreturn]] void differ(const std::string& a, const std::string& b, const std::string& what) {
  throw InputError(b + ": has " + what + " " + a +
                   "; the slices of a volume agree in it (two scans under one series?)");
}

void check_formats(const std::vector<ImageHeader>& images) {
  const ImageHeader& first = images.front();
  for (const ImageHeader& h : images) {
    const PixelFormat &a = first.format, &b = h.format;
    if (a.columns != b.columns || a.rows != b.rows)
      differ(first.file, h.file,
             std::to_string(b.columns) + " x " + std::to_string(b.rows) + " pixels, not the " +
                 std::to_string(a.columns) + " x " + std::to_string(a.rows) + " of");
    if (a.allocated != b.allocated || a.is_signed != b.is_signed || a.inverted != b.inverted)
      differ(first.file, h.file, "another pixel type (bits, sign or MONOCHROME1/2) than");
  }
}

void check_planes(const std::vector<Slice>& slices) {
  const Slice& a = slices.front();
  for (const Slice& b : slices) {
    if (length(minus(a.along_row, b.along_row)) > rounding || length(minus(a.along_column, b.along_column)) > rounding)
      differ(name_of(a), name_of(b), "another ImageOrientationPatient than");
    if (std::fabs(a.row_spacing - b.row_spacing) > rounding * a.row_spacing ||
        std::fabs(a.column_spacing - b.column_spacing) > rounding * a.column_spacing)
      differ(name_of(a), name_of(b), "another PixelSpacing than");
  }
}

// Distances between neighbours along the normal: one value, or the reason why not.
void check_distances(const std::vector<Slice>& slices, const std::vector<double>& at) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < at.size(); ++i) gaps.push_back(at[i] - at[i - 1]);
  std::vector<double> sorted = gaps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2], least = 1e-3 * std::max(sorted.back(), 1e-6);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const std::string pair = name_of(slices[i]) + " and " + name_of(slices[i + 1]);
    if (gaps[i] < least)
      throw InputError(pair + " lie at the same position, " + text(at[i]) +
                       " mm along the normal; copies, echoes or time points: keep one volume per folder");
    if (std::fabs(gaps[i] - usual) <= uneven * usual) continue;
    const double steps = std::round(gaps[i] / usual);
    const std::string distance = text(gaps[i]) + " mm, elsewhere it is " + text(usual) + " mm";
    if (steps >= 2 && std::fabs(gaps[i] - steps * usual) <= steps * uneven * usual)
      throw InputError("between " + pair + " " + text(steps - 1) + (steps == 2 ? " slice is" : " slices are") +
                       " missing: their distance is " + distance);
    throw InputError("the slices are not evenly spaced: between " + pair + " the distance is " + distance +
                     "; resample them to a regular grid first");
  }
}

// The mean step from slice to slice, and how far the slices are from it.
Vector3 mean_step(const std::vector<Slice>& slices, std::vector<std::string>& notes) {
  const auto n = static_cast<double>(slices.size() - 1);
  Vector3 step = minus(slices.back().position, slices.front().position);
  for (double& x : step) x /= n;
  double worst = 0;
  const Slice* worst_slice = &slices.front();
  for (std::size_t i = 0; i < slices.size(); ++i) {
    Vector3 even = slices.front().position;
    for (std::size_t a = 0; a < 3; ++a) even[a] += static_cast<double>(i) * step[a];
    const double off = length(minus(slices[i].position, even));
    if (off > worst) {
      worst = off;
      worst_slice = &slices[i];
    }
  }
  if (worst > uneven * length(step))
    throw InputError(name_of(*worst_slice) + ": lies " + text(worst) +
                     " mm beside the line through the first and the last slice; the slices form no regular grid");
  if (worst > 1e-6) notes.push_back("the slices lie up to " + text(worst) + " mm beside their even places");
  return step;
}

}  // namespace

bool Stack::one_scaling() const {
  return std::all_of(slice.begin(), slice.end(), [&](const Slice& s) {
    return s.slope == slice.front().slope && s.intercept == slice.front().intercept;
  });
}

Stack make_stack(const std::vector<ImageHeader>& images) {
  Stack stack;
  check_formats(images);
  stack.format = images.front().format;
  for (const ImageHeader& h : images) stack.slice.insert(stack.slice.end(), h.slice.begin(), h.slice.end());
  std::vector<Slice>& slices = stack.slice;
  if (slices.size() < 2)
    throw InputError(images.front().file + ": is the only slice of its series; a volume needs at least 2");
  check_planes(slices);
  const Slice& first = slices.front();
  const Vector3 normal = cross(first.along_row, first.along_column);
  std::stable_sort(slices.begin(), slices.end(),
                   [&](const Slice& a, const Slice& b) { return dot(a.position, normal) < dot(b.position, normal); });
  std::vector<double> at;
  for (const Slice& s : slices) at.push_back(dot(s.position, normal));
  check_distances(slices, at);
  const Vector3 step = mean_step(slices, stack.notes);
  const double tilt = std::acos(std::min(1.0, dot(step, normal) / length(step) / length(normal)));
  if (tilt > uneven)
    stack.notes.push_back("the slices are sheared by " + text(tilt * 180 / std::numbers::pi) +
                          " degrees (gantry tilt); the affine follows them, nothing is resampled");
  const Slice& s = slices.front();
  for (std::size_t r = 0; r < 3; ++r) {
    const double sign = r < 2 ? -1 : 1;                                      // LPS -> RAS
    stack.to_world.m[3 * r] = 0 + sign * s.along_row[r] * s.column_spacing;  // 0 +: no negative zero
    stack.to_world.m[3 * r + 1] = 0 + sign * s.along_column[r] * s.row_spacing;
    stack.to_world.m[3 * r + 2] = 0 + sign * step[r];
    stack.to_world.t[r] = 0 + sign * s.position[r];
  }
  return stack;
}

}  // namespace dvrlab::dicom
