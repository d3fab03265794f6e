// The NRRD reader: 3-D scalar volumes, attached or detached, in every common encoding and byte order.
#include <cstring>

#include "framework/interfaces/field.h"
#include "plugins/data/nrrd/nrrd_header.h"

namespace dvrlab::nrrd {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .nrrd file or the .nhdr header, relative to the config's folder; ${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/hydrogenatom.nrrd")"}};

class Nrrd : public GridFilePlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    const bool magic = start.size() >= 7 && std::memcmp(start.data(), "NRRD000", 7) == 0;
    return magic || path.ends_with(".nrrd") || path.ends_with(".nhdr");
  }

 private:
  GridFile open(const ParameterSet& p, const LoadContext& context) const override {
    return open_nrrd(resolve_path(p.text("file"), context, p.path_of("file")));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "nrrd", "1.1.0", Nrrd, parameters,
              "Reads 3-D scalar volumes from NRRD files: .nrrd and .nhdr, raw, compressed or text, both byte orders.",
              "Teem: Nrrd: definition of the format, https://teem.sourceforge.net/nrrd/format.html")

}  // namespace dvrlab::nrrd
