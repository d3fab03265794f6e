#include "plugins/estimator/preintegrated/table_build.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>
#include <thread>
#include <utility>

#include "backends/cpu/isa.h"
#include "framework/interfaces/error.h"
#include "plugins/estimator/preintegrated/table_inputs.h"
#include "plugins/estimator/preintegrated/table_library.h"

namespace dvrlab::preintegrated {

namespace {
constexpr std::size_t huge_page = std::size_t(2) << 20;
// Above this size a table does not stay in the caches: writing past them saves reading every line first.
constexpr std::uint64_t stream_above = std::uint64_t(32) << 20;

struct Free {
  void operator()(void* p) const { std::free(p); }
};

// A step of the build writes one line into every row: with pages of 4 KiB every write would miss the address cache.
std::shared_ptr<float> allocate(std::uint64_t bytes) {
  const std::size_t unit = bytes >= huge_page ? huge_page : 64, size = (bytes + unit - 1) / unit * unit;
  auto* p = static_cast<float*>(std::aligned_alloc(unit, size));
  if (p == nullptr) throw std::bad_alloc();
  if (unit == huge_page) madvise(p, size, MADV_HUGEPAGE);  // advice only: without huge pages it is slower
  return {p, Free{}};
}

std::uint64_t buffer_bytes(int n) { return std::uint64_t(table_entries(n)) * 4 * sizeof(float); }
}  // namespace

std::uint64_t Table::bytes(int n, const TableRequest& request) {
  return 2 * std::uint64_t(request.groups()) * buffer_bytes(n);
}

Table::Table(Cells cells, TableRequest request, double h, const BuildMeans& means)
    : cells_(std::move(cells)), request_(std::move(request)), h_(h) {
  check(request_);
  const int n = cells_.grid.n;
  if (!(h > 0) || !std::isfinite(h) || n < 2 || n > 65000) {
    std::ostringstream what;
    what << "pre-integration table: " << n << " values and the segment length " << h
         << "; give 2 to 65000 values and a finite length above 0";
    throw InputError(what.str());
  }
  memory_ = allocate(bytes(n, request_));
  compute(0, n - 1, means);
}

Table Table::copy() const {
  Table other = *this;
  const std::uint64_t size = bytes(values(), request_);
  other.memory_ = allocate(size);
  std::memcpy(other.memory_.get(), memory_.get(), size);
  return other;
}

bool Table::update(Cells cells, const BuildMeans& means) {
  const auto changed = changed_cells(cells_, cells);
  cells_ = std::move(cells);
  if (changed) compute(changed->first, changed->second, means);
  return changed.has_value();
}

const float* Table::buffer(Direction direction, int group) const {
  const int block = (direction == Direction::ascending ? 0 : request_.groups()) + group;
  return memory_.get() + 4 * table_entries(values()) * block;
}

std::int64_t Table::place(int i, int j, int output) const {
  const Direction d = j >= i ? Direction::ascending : Direction::descending;
  return buffer(d, output / 4) - memory_.get() + table_entry(d, values(), i, j) * 4 + output % 4;
}

float Table::at(int i, int j, int output) const { return memory_.get()[place(i, j, output)]; }

void Table::set(int i, int j, int output, float x) { memory_.get()[place(i, j, output)] = x; }

void Table::compute(int first, int last, const BuildMeans& means) {
  const dvr_table_module& module = table_module(means.folder, means.isa);
  const TableInputs inputs(cells_, request_, h_);
  dvr_table_job job = inputs.job();
  job.stream = bytes(values(), request_) > stream_above ? 1 : 0;
  float* out = memory_.get();
  for (dvr_table_side& side : job.side)
    for (int g = 0; g < job.groups; ++g, out += 4 * table_entries(values())) side.out[g] = out;
  // Blocks with small m are the longest and come first: the threads end together.
  const int blocks = (values() + module.lanes - 1) / module.lanes;
  const int threads = std::clamp(cpu::thread_count(means.threads), 1, blocks);
  const std::size_t scratch_bytes = (module.scratch_bytes(&job) + 63) / 64 * 64;
  std::vector<std::unique_ptr<void, Free>> scratch;
  for (int k = 0; k < threads; ++k)
    if (!scratch.emplace_back(std::aligned_alloc(64, scratch_bytes))) throw std::bad_alloc();
  std::atomic<int> next = 0;
  const auto work = [&](void* memory) {
    for (int b = next++; b < blocks; b = next++) module.block(&job, memory, b * module.lanes, first, last);
  };
  std::vector<std::jthread> helpers;
  for (int k = 1; k < threads; ++k) helpers.emplace_back(work, scratch[std::size_t(k)].get());
  work(scratch[0].get());
}

}  // namespace dvrlab::preintegrated
