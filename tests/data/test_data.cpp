#include "tests/data/test_data.h"

#include <bzlib.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <iterator>

namespace dvrlab::test {

const Registry& registry() {
  static const Registry instance;
  return instance;
}

ParameterSet parameters(const std::string& kind, const std::string& name, const nlohmann::json& values) {
  const PluginDescriptor& d = *registry().find(kind, name).descriptor;
  const std::vector<Parameter> declared(d.parameters, d.parameters + d.parameter_count);
  nlohmann::json all = nlohmann::json::object();
  for (const Parameter& p : declared)
    if (p.default_value) all[p.name] = nlohmann::json::parse(p.default_value);
  all.update(values);
  return ParameterSet(kind, declared, all);
}

std::shared_ptr<const Field> load(const std::string& name, const nlohmann::json& values, const LoadContext& context) {
  return registry().get<DataPlugin>("data", name).load(parameters("data", name, values), context);
}

std::shared_ptr<const GridField> load_grid(const std::string& name, const nlohmann::json& values,
                                           const LoadContext& context) {
  return std::dynamic_pointer_cast<const GridField>(load(name, values, context));
}

std::string load_error(const std::string& name, const nlohmann::json& values, const LoadContext& context) {
  try {
    registry().get<DataPlugin>("data", name).check(parameters("data", name, values));  // as validation does
    load(name, values, context);
  } catch (const InputError& e) {
    return e.what();
  } catch (const NotSupported& e) {
    return std::string("NotSupported: ") + e.what();
  }
  return "";
}

bool has_note(const Field& field, const std::string& part) {
  return std::any_of(field.notes.begin(), field.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

Vector3 world(const Field& field, const Vector3& index) { return field.to_world.point(index); }

std::string scratch(const std::string& file) {
  struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("dvrlab_data_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return (folder.path / file).string();
}

void write(const std::string& path, const Bytes& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Bytes read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

Bytes gzip(const Bytes& bytes) {
  const std::string path = scratch("packed.gz");
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return read(path);
}

Bytes zlib(const Bytes& bytes) {
  uLongf size = compressBound(bytes.size());
  Bytes out(size);
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

Bytes bzip2(const Bytes& bytes) {
  auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 600);
  Bytes out(size), in = bytes;
  BZ2_bzBuffToBuffCompress(out.data(), &size, in.data(), static_cast<unsigned>(in.size()), 9, 0, 0);
  out.resize(size);
  return out;
}

Bytes hex(const Bytes& bytes) {
  Bytes out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto b = static_cast<unsigned char>(bytes[i]);
    out.push_back("0123456789abcdef"[b >> 4]);
    out.push_back("0123456789ABCDEF"[b & 15]);
    if (i % 7 == 6) out.push_back('\n');
  }
  return out;
}

std::string shared_data(const std::string& file) {
  const char* folder = std::getenv("DVRLAB_SHARED_DATA");
  const std::filesystem::path path = std::filesystem::path(folder ? folder : DVRLAB_SHARED_DATA) / file;
  return std::filesystem::exists(path) ? path.string() : "";
}

}  // namespace dvrlab::test
