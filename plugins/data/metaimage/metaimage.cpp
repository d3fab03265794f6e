// The MetaImage reader: 3-D scalar volumes, .mha and .mhd, raw, compressed or text, of either byte order.
#include <string_view>

#include "framework/interfaces/field.h"
#include "plugins/data/metaimage/metaimage_header.h"

namespace dvrlab::metaimage {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .mha file or the .mhd header, relative to the config's folder; ${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/letter_f.mhd")"}};

class MetaImage : public GridFilePlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    const std::size_t value = text.find_first_not_of(" \t=", 10);
    const bool magic = text.starts_with("ObjectType") && value != text.npos && text.substr(value, 5) == "Image";
    return magic || path.ends_with(".mha") || path.ends_with(".mhd");
  }

 private:
  GridFile open(const ParameterSet& p, const LoadContext& context) const override {
    return open_metaimage(resolve_path(p.text("file"), context, p.path_of("file")));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "metaimage", "1.0.0", MetaImage, parameters,
              "Reads 3-D scalar volumes from MetaImage files: .mha and .mhd, raw, compressed or text.",
              "MetaIO: MetaImage, https://itk.org/Wiki/ITK/MetaIO/Documentation")

}  // namespace dvrlab::metaimage
