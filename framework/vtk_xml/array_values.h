// The numbers of one data array, whichever way the file codes them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "framework/scene/mapped_file.h"
#include "framework/scene/voxels.h"
#include "framework/vtk_xml/vtk_xml.h"

namespace dvrlab::vtk_xml {

/// The array's number type. Throws InputError, `where` in front, for what is no number ("String").
SourceType type_of(const DataArray& array, const std::string& where);

/// `count` numbers; those of appended raw data without compression are those of the mapped file. Throws InputError,
/// `where` in front, before memory is taken where the file's size shows that they cannot be there.
SourceVoxels read_values(const XmlFile& header, const DataArray& array, std::uint64_t count,
                         const std::shared_ptr<const MappedFile>& file, const std::string& where);

/// Bytes that read_values allocates at the most, from the header alone.
std::uint64_t read_values_bytes(const XmlFile& header, const DataArray& array, std::uint64_t count,
                                std::uint64_t file_size);

}  // namespace dvrlab::vtk_xml
