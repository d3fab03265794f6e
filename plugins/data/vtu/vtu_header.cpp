#include "plugins/data/vtu/vtu_header.h"

#include "framework/interfaces/error.h"

namespace dvrlab::vtu {
namespace {

using vtk_xml::Attributes;
using vtk_xml::DataArray;

const std::string grid_path = "/VTKFile/UnstructuredGrid", piece_path = grid_path + "/Piece";

class Reader : public vtk_xml::FileReader {
 public:
  Reader(std::span<const std::byte> file, const std::string& name, VtuHeader& header)
      : FileReader(file, name, header), name_(name), header_(header) {}

  void finish() const {
    if (header_.pieces.empty()) throw InputError(name_ + ": <UnstructuredGrid> holds no <Piece>");
  }

 private:
  void check_type(const std::string& type, const Attributes& a) override {
    if (type == "PUnstructuredGrid")
      a.fail(
          "type is \"PUnstructuredGrid\", a list of other files; name one of these, or store the mesh as one .vtu "
          "file");
    if (type != "UnstructuredGrid") a.fail("type is \"" + type + "\"; only UnstructuredGrid is read");
  }

  std::vector<DataArray>* arrays_at(const std::string& path) override {
    if (header_.pieces.empty()) return nullptr;
    Piece& p = header_.pieces.back();
    if (path == piece_path + "/Points/DataArray") return &p.places;
    if (path == piece_path + "/Cells/DataArray") return &p.topology;
    if (path == piece_path + "/PointData/DataArray") return &p.point_data;
    return path == piece_path + "/CellData/DataArray" ? &p.cell_data : nullptr;
  }

  void element(const std::string& path, const Attributes& a) override {
    if (path == piece_path) {
      a.require("NumberOfPoints");
      a.require("NumberOfCells");
      Piece& p = header_.pieces.emplace_back();
      p.points = a.natural("NumberOfPoints", 0);
      p.cells = a.natural("NumberOfCells", 0);
    } else if (path == piece_path + "/PointData") {
      header_.pieces.back().point_scalars = a.text("Scalars", "");
    } else if (path == piece_path + "/CellData") {
      header_.pieces.back().cell_scalars = a.text("Scalars", "");
    }
  }

  const std::string& name_;
  VtuHeader& header_;
};

}  // namespace

VtuHeader read_header(std::span<const std::byte> file, const std::string& name) {
  VtuHeader header;
  Reader reader(file, name, header);
  scan_xml(file, name, reader);
  reader.finish();
  return header;
}

}  // namespace dvrlab::vtu
