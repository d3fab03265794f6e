// A walk over the elements of a DICOM file before the library sees it: GDCM takes memory for whatever length a
// damaged element announces.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace dvrlab::dicom {

/// True when "DICM" stands at byte 128.
bool has_magic(std::span<const std::byte> file);

/// Throws InputError, naming file, element and byte, when an element announces more bytes than the file still holds.
/// What the walk does not understand (private encodings, deflated files) is left to the library.
void check_lengths(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::dicom
