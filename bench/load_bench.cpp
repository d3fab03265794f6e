// What loading a volume costs, SHA-256 and range of values included, against the least work that it contains: plain
// zlib decompression of the same stream, or the hash of the same bytes. All contenders run once per round, round after
// round, so that a change of the machine's load meets all of them. Prints a Markdown table.
#include <unistd.h>
#include <zlib.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"
#include "framework/scene/gzip.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct Options {
  int rounds = 9, side = 256, mebibytes = 1024;
  std::string folder = std::filesystem::temp_directory_path().string();
};

struct Contender {
  std::string name;
  std::function<void()> work;
  std::string against;  // name of another contender; "" for none
  double most = 0;      // goal: of the ratio, or of the milliseconds without `against`
  std::vector<double> ms = {};
};

/// A file of this process, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile(const Options& o, const std::string& ending)
      : name_(o.folder + "/dvrlab_load_bench_" + std::to_string(::getpid()) + ending) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(name_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& name() const { return name_; }
  void write(const std::string& head, const std::vector<unsigned char>& bytes, std::size_t times = 1) const {
    std::ofstream out(name_, std::ios::binary);
    out << head;
    for (std::size_t i = 0; i < times; ++i)
      out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) throw NotSupported(name_ + ": cannot be written");
  }

 private:
  std::string name_;
};

std::shared_ptr<const Field> load(const std::string& reader, const nlohmann::json& given) {
  const PluginDescriptor& d = *registry().find("data", reader).descriptor;
  const std::vector<Parameter> declared(d.parameters, d.parameters + d.parameter_count);
  nlohmann::json all = nlohmann::json::object();
  for (const Parameter& p : declared)
    if (p.default_value != nullptr) all[p.name] = nlohmann::json::parse(p.default_value);
  all.update(given);
  return registry().get<DataPlugin>("data", reader).load(ParameterSet("data", declared, all), {});
}

/// The engine CT, repeated to side^3 voxels. uint16: 12 bits of it and 4 bits of noise, as a scanner has them.
std::vector<unsigned char> voxels(int side, bool wide) {
  const auto engine =
      std::dynamic_pointer_cast<const GridField>(load("nrrd", {{"file", DVRLAB_SOURCE "/data/engine.nrrd"}}));
  std::vector<unsigned char> out;
  std::uint32_t noise = 1;
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const auto v = static_cast<unsigned>(engine->at(i % engine->dims[0], j % engine->dims[1], k % engine->dims[2]));
        noise = noise * 1664525 + 1013904223;
        const unsigned u = wide ? 16 * v + (noise >> 28) : v;
        out.push_back(static_cast<unsigned char>(u));
        if (wide) out.push_back(static_cast<unsigned char>(u >> 8));
      }
  return out;
}

std::vector<unsigned char> gzipped(const std::vector<unsigned char>& in) {
  z_stream z{};
  deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::vector<unsigned char> out(deflateBound(&z, in.size()));
  z.next_in = const_cast<unsigned char*>(in.data());
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

/// The whole stream in one call into memory that is there already: nothing decompresses with zlib in less time.
void inflate_all(const std::vector<unsigned char>& in, std::vector<unsigned char>& out) {
  z_stream z{};
  inflateInit2(&z, 15 + 16);
  z.next_in = const_cast<unsigned char*>(in.data());
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  const int result = inflate(&z, Z_FINISH);
  inflateEnd(&z);
  if (result != Z_STREAM_END) throw InputError("zlib cannot read what it wrote");
}

std::string nrrd_header(const std::string& type, int nx, int ny, int nz, const std::string& encoding) {
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: " + std::to_string(nx) + " " + std::to_string(ny) + " " +
         std::to_string(nz) + "\nendian: little\nspacings: 1 1 1\nencoding: " + encoding + "\n\n";
}

void measure(std::vector<Contender> all, int rounds) {
  for (int round = 0; round <= rounds; ++round)  // the first one warms up
    for (Contender& c : all) {
      const auto start = std::chrono::steady_clock::now();
      c.work();
      if (round > 0)
        c.ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
  for (const Contender& c : all) {
    std::printf("| %s | %.1f | %.1f |", c.name.c_str(), least(c.ms), median(c.ms));
    for (const Contender& other : all) {
      if (other.name != c.against) continue;
      std::vector<double> ratios;
      for (std::size_t i = 0; i < c.ms.size(); ++i) ratios.push_back(c.ms[i] / other.ms[i]);
      std::printf(" %.2f | %.2f |", least(c.ms) / least(other.ms), median(ratios));
    }
    if (c.against.empty()) std::printf(" | |");
    if (c.most > 0) {
      std::printf(" <= %g%s |\n", c.most, c.against.empty() ? " ms" : "");
    } else {
      std::printf(" |\n");
    }
  }
}

void compressed(const Options& o, bool wide) {
  const TemporaryFile file(o, ".nrrd");
  const std::vector<unsigned char> plain = voxels(o.side, wide), packed = gzipped(plain);
  file.write(nrrd_header(wide ? "uint16" : "uint8", o.side, o.side, o.side, "gzip"), packed);
  std::vector<unsigned char> out(plain.size());
  const std::string type = wide ? "uint16" : "uint8", size = std::to_string(o.side) + "^3 ";
  const std::string zlib = "zlib, " + size + type;
  measure({{zlib, [&] { inflate_all(packed, out); }, "", 0},
           {"libdeflate, " + size + type,
            [&] {
              gunzip_exactly({reinterpret_cast<const std::byte*>(packed.data()), packed.size()},
                             {reinterpret_cast<std::byte*>(out.data()), out.size()});
            },
            zlib, 0},
           {"load nrrd gzip, " + size + type,
            [&] {
              load("nrrd", {{"file", file.name()}});
            },
            zlib, 1.2}},
          o.rounds);
  if (out != plain) throw InputError("what was decompressed is not what was compressed");
}

void uncompressed(const Options& o) {
  // Slabs of 1024 x 1024 bytes; as float32 a quarter of their number, of 1.0 and its neighbours.
  std::vector<unsigned char> slab(1 << 20);
  for (std::size_t i = 0; i < slab.size(); ++i)
    slab[i] = i % 4 < 2 ? static_cast<unsigned char>(i * i / 977) : i % 4 == 2 ? 0x80 : 0x3f;
  const auto slabs = static_cast<std::size_t>(std::max(2, o.mebibytes));
  const std::string size = std::to_string(slabs) + " MiB ";
  const double most = slabs == 1024 ? 1500 : 0;
  const TemporaryFile raw(o, ".raw"), nrrd(o, ".nhdr");
  raw.write("", slab, slabs);
  std::string header = nrrd_header("float", 512, 512, static_cast<int>(slabs), "raw");
  header.insert(header.size() - 1, "data file: " + std::filesystem::path(raw.name()).filename().string() + "\n");
  nrrd.write(header, {});
  measure(
      {{"SHA-256, " + size + "mapped", [&] { sha256({MappedFile::open(raw.name())->bytes()}); }, "", 0},
       {"load raw, " + size + "uint8",
        [&] {
          load("raw", {{"file", raw.name()}, {"size", {1024, 1024, static_cast<int>(slabs)}}, {"voxel_type", "uint8"}});
        },
        "", most},
       {"load nrrd raw, " + size + "float32",
        [&] {
          load("nrrd", {{"file", nrrd.name()}});
        },
        "", most}},
      o.rounds);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"What loading a volume costs, measured in one interleaved run"};
  app.add_option("--rounds", o.rounds, "loads of every kind")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--side", o.side, "voxels along each axis of the compressed volumes")
      ->check(CLI::Range(2, 1024))
      ->capture_default_str();
  app.add_option("--mebibytes", o.mebibytes, "size of the uncompressed volumes")
      ->check(CLI::Range(2, 65536))
      ->capture_default_str();
  app.add_option("--folder", o.folder, "where the files are written")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf(
        "| what | ms, least | ms, median | ratio to zlib, of the least | ratio, median over rounds | goal "
        "|\n|---|---|---|---|---|---|\n");
    compressed(o, false);
    compressed(o, true);
    uncompressed(o);
    return 0;
  } catch (const NotSupported& e) {
    std::fprintf(stderr, "not supported: %s\n", e.what());
    return 3;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
  }
}
