// What a case states before it allocates is what it takes: the process's peak grows by the stated sum, on every
// backend, and a case beyond its limit is refused with the sum and its parts.
#include <cstdio>
#include <fstream>

#include "framework/config/experiment.h"
#include "framework/render_case.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

/// VmHWM and VmRSS of this process in bytes.
double status_bytes(const std::string& name) {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;) {
    double kib = 0;
    if (word == name + ":" && in >> kib) return kib * 1024;
  }
  return -1;
}

/// Forgets the peak so far. False where the kernel does not allow that.
bool reset_peak() {
  std::ofstream out("/proc/self/clear_refs");
  out << "5" << std::flush;
  return out.good();
}

PlannedCase case_of(int size, const nlohmann::json& backend, const nlohmann::json& more = nlohmann::json::object()) {
  nlohmann::json config = {
      {"data", {{"type", "procedural"}, {"field", "sphere"}, {"size", {size, size, size}}, {"voxel_type", "float32"}}},
      {"optical_model",
       {{"type", "absorption_emission"}, {"extinction", {{0, 0}, {1, 2}}}, {"color", {{0, 1, 0.5, 0.25}}}}},
      {"estimator", {{"type", "direct"}}},
      {"camera", {{"type", "orthographic"}, {"position", {0, 0, 3}}, {"up", {0, 1, 0}}}},
      {"image", {{"size", {32, 32}}}},
      {"backend", backend}};
  config.merge_patch(more);
  return plan_experiment(parse_document(config.dump(), "test.json", DVRLAB_SOURCE), registry()).cases.at(0);
}

CaseRecord run(CaseRenderer& renderer, const PlannedCase& c) {
  CaseRecord record;
  record.plan = &c;
  const Scene& scene = renderer.scene(c.resolved, record);
  renderer.render(c.resolved, scene, record);
  return record;
}

class Stated : public testing::TestWithParam<const char*> {};

TEST_P(Stated, BytesAreWhatIsTaken) {
  const nlohmann::json backend = {{"type", GetParam()}};
  CaseRenderer renderer(registry());
  const PlannedCase small = case_of(16, backend), large = case_of(224, backend);
  try {
    run(renderer, small);  // drivers, compilers and thread pools take theirs at the first frame
  } catch (const NotSupported& e) {
    GTEST_SKIP() << "not supported: " << e.what();
  }
  if (!reset_peak()) GTEST_SKIP() << "not supported: the kernel does not reset the peak of this process";
  const double before = status_bytes("VmRSS");
  const CaseRecord record = run(renderer, large);
  double stated = 0;
  for (const auto& [part, bytes] : record.memory) stated += bytes;
  const double taken = status_bytes("VmHWM") - before;
  std::printf("%s: stated %.1f MiB, taken %.1f MiB\n", GetParam(), stated / 1048576, taken / 1048576);
  const double voxels = 224.0 * 224 * 224 * 4;
  EXPECT_GE(stated, voxels);
  // A driver's own bookkeeping and freed pages of the small frame are the slack on both sides.
  const double slack = 12 << 20;
  EXPECT_LE(taken, stated + slack) << "more than was stated";
  EXPECT_GE(taken, voxels - slack) << "the measurement does not see the voxels";
}

INSTANTIATE_TEST_SUITE_P(Backends, Stated, testing::Values("cpu", "vulkan", "opengl"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(Fp64, TheImageInDoubleIsStatedAndTaken) {
  constexpr int side = 1024;
  constexpr double bytes = 6.0 * side * side * (sizeof(float) + sizeof(double));
  CaseRenderer renderer(registry());
  const PlannedCase c =
      case_of(16, {{"type", "cpu"}},
              {{"precision", "fp64"}, {"image", {{"size", {side, side}}}}, {"sampling", {{"step", 16}}}});
  const PlannedCase small = case_of(16, {{"type", "cpu"}}, {{"precision", "fp64"}});
  run(renderer, small);
  if (!reset_peak()) GTEST_SKIP() << "not supported: the kernel does not reset the peak of this process";
  const double before = status_bytes("VmRSS");
  const CaseRecord record = run(renderer, c);
  double stated = 0;
  for (const auto& [part, size] : record.memory)
    if (part == "backend 'cpu'") stated = size;
  const double taken = status_bytes("VmHWM") - before;
  std::printf("fp64 image: stated %.1f MiB, taken %.1f MiB\n", stated / 1048576, taken / 1048576);
  EXPECT_EQ(stated, bytes);
  EXPECT_NEAR(taken, bytes, 12 << 20);
}

TEST(Limit, RefusalNamesEveryPartAndTheSum) {
  CaseRenderer renderer(registry());
  const PlannedCase c = case_of(64, {{"type", "cpu"}}, {{"limits", {{"memory", 900000}}}});
  try {
    run(renderer, c);
    FAIL() << "expected NotSupported";
  } catch (const NotSupported& e) {
    const std::string text = e.what();
    for (const char* word : {"needs 1.0 MiB", "data 1.0 MiB", "limits.memory allows 0.9 MiB"})
      EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
  }
}

TEST(Limit, NothingIsAllocatedBeforeTheRefusal) {
  CaseRenderer renderer(registry());
  if (!reset_peak()) GTEST_SKIP() << "not supported: the kernel does not reset the peak of this process";
  const double before = status_bytes("VmRSS");
  const PlannedCase c = case_of(640, {{"type", "cpu"}}, {{"limits", {{"memory", 64 << 20}}}});  // 1 GiB of voxels
  EXPECT_THROW(run(renderer, c), NotSupported);
  EXPECT_LE(status_bytes("VmHWM") - before, 32.0 * (1 << 20));
}

}  // namespace
}  // namespace dvrlab::test
