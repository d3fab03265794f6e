// Instruction sets of this processor.
#pragma once

#include <string>
#include <vector>

namespace dvrlab::cpu {

/// "auto" -> the widest usable set; another name is returned as it is. Throws NotSupported when the processor
/// lacks it.
std::string choose_isa(const std::string& wanted);

/// All that this processor has, narrowest first: {"scalar", "sse4.2", "avx2"}.
std::vector<std::string> usable_isas();

/// The processor's own name, e.g. "AMD EPYC 9R14".
std::string processor_name();

/// 0 -> the hardware threads that this process may use.
int thread_count(int wanted);

}  // namespace dvrlab::cpu
