// One input -> no crash, no sanitizer report, no leak, no memory beyond what was stated; either a result or one of the
// two errors that users see, with a sentence in it. Linked with libFuzzer (./dev fuzz) or with replay.cpp (ctest).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace dvrlab::fuzz {

/// Runs `work`; swallows InputError and NotSupported and aborts when one of them says nothing, or when anything else
/// is thrown.
void expect_result_or_error(const std::function<void()>& work);

/// A file of this process in memory with these bytes; the same name at every call. Beside it lie the files of the
/// folder `companions` where there is one: a format may need more than one file.
const std::string& input_file(const std::uint8_t* data, std::size_t size, const std::string& companions);

}  // namespace dvrlab::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
