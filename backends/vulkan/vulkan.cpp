// Backend "vulkan": the march as one compute shader. See vulkan.md.
#include "backends/vulkan/device.h"
#include "backends/vulkan/report.h"
#include "framework/shader/gpu_session.h"

namespace dvrlab {
namespace {

constexpr Parameter parameters[] = {
    {"device", ParameterType::text, "", "\"\"", "",
     "Index of the device or a part of its name; empty: the first discrete GPU, then integrated, virtual, software.",
     Affects::speed},
    {"band_ms", ParameterType::number, "ms", "100", "(0,inf)",
     "Time that one dispatch should take; rows are split into bands to stay below it.", Affects::speed, "", "1"},
    {"validation", ParameterType::boolean, "", "false", "",
     "Runs under the validation layer, synchronization included; any message is an error.", Affects::speed, "", "true"},
};

class Vulkan final : public BackendPlugin {
 public:
  BackendReport report() const override { return vulkan_report(); }
  std::unique_ptr<BackendSession> open(const ParameterSet& p, const std::string&) const override {
    return std::make_unique<GpuSession>(std::make_unique<VulkanDevice>(p.text("device"), p.boolean("validation")),
                                        p.number("band_ms") * 1e-3);
  }
};

}  // namespace
}  // namespace dvrlab

DVRLAB_PLUGIN("backend", "vulkan", "1.0.0", dvrlab::Vulkan, dvrlab::parameters,
              "Runs the march as a Vulkan 1.1 compute shader, without a display.", "")
