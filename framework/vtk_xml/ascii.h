// Numbers written as text.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "framework/scene/voxels.h"

namespace dvrlab::vtk_xml {

/// `count` numbers, separated by white space, in this machine's byte order. Throws InputError, `where` in front, for
/// another count, or naming the number that its type cannot hold; before memory is taken where the text is too short.
std::shared_ptr<const void> read_ascii(std::span<const std::byte> text, SourceType type, std::uint64_t count,
                                       const std::string& where);

}  // namespace dvrlab::vtk_xml
