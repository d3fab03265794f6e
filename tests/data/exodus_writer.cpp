#include "tests/data/exodus_writer.h"

#include <netcdf.h>

#include <algorithm>
#include <stdexcept>

namespace dvrlab::test {
namespace {

void check(int error) {
  if (error != NC_NOERR) throw std::runtime_error(nc_strerror(error));
}

class Writer {
 public:
  Writer(const std::string& file, NetcdfKind kind, bool single) : number_(single ? NC_FLOAT : NC_DOUBLE) {
    constexpr int modes[] = {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4};
    check(nc_create(file.c_str(), NC_CLOBBER | modes[static_cast<int>(kind)], &id_));
  }
  ~Writer() { nc_close(id_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  int dimension(const std::string& name, std::size_t length) {
    int d = 0;
    check(nc_def_dim(id_, name.c_str(), length, &d));
    return d;
  }
  int variable(const std::string& name, const std::vector<int>& dimensions) {
    return variable(name, number_, dimensions);
  }
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) {
    int v = 0;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &v));
    return v;
  }
  void attribute(int variable, const char* name, const std::string& text) {
    check(nc_put_att_text(id_, variable, name, text.size(), text.c_str()));
  }
  /// What Exodus's own library asks for.
  void version(int word) {
    const float api = 5.14F;
    const int large = 1;
    for (const char* name : {"api_version", "version"})
      check(nc_put_att_float(id_, NC_GLOBAL, name, NC_FLOAT, 1, &api));
    check(nc_put_att_int(id_, NC_GLOBAL, "floating_point_word_size", NC_INT, 1, &word));
    check(nc_put_att_int(id_, NC_GLOBAL, "file_size", NC_INT, 1, &large));
  }
  void finish_header() { check(nc_enddef(id_)); }
  void put(int variable, const std::vector<double>& x) { check(nc_put_var_double(id_, variable, x.data())); }
  void put(int variable, const std::vector<int>& x) { check(nc_put_var_int(id_, variable, x.data())); }
  void put_step(int variable, std::size_t step, const double* x, std::size_t count) {
    const std::size_t from[] = {step, 0}, size[] = {1, count};
    check(nc_put_vara_double(id_, variable, from, size, x));
  }
  void put_time(int variable, std::size_t step, double t) { check(nc_put_var1_double(id_, variable, &step, &t)); }
  void put_names(int variable, const std::vector<std::string>& names, std::size_t width) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::string row = names[k];
      row.resize(width);
      const std::size_t from[] = {k, 0}, size[] = {1, width};
      check(nc_put_vara_text(id_, variable, from, size, row.data()));
    }
  }

 private:
  int id_ = -1;
  nc_type number_;
};

}  // namespace

void write_exodus(const std::string& file, const ExodusContents& c, NetcdfKind kind, bool single) {
  constexpr std::size_t width = 33;
  Writer out(file, kind, single);
  out.dimension("num_dim", static_cast<std::size_t>(c.axes));
  const int time = out.dimension("time_step", NC_UNLIMITED), points = out.dimension("num_nodes", c.points.size());
  const int letters = out.dimension("len_name", width);
  const int blocks = out.dimension("num_el_blk", c.blocks.size());
  std::size_t elements = 0;
  for (const ExodusContents::Block& b : c.blocks) elements += b.node.size() / static_cast<std::size_t>(b.nodes);
  out.dimension("num_elem", elements);
  out.version(single ? 4 : 8);
  const int status = out.variable("eb_status", NC_INT, {blocks}), numbers = out.variable("eb_prop1", NC_INT, {blocks});
  out.attribute(numbers, "name", "ID");
  const int time_of = out.variable("time_whole", {time});
  std::vector<int> axis, lists, cells, of_points, names;
  for (const char* name : {"coordx", "coordy", "coordz"}) axis.push_back(out.variable(name, {points}));
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    const std::string number = std::to_string(b + 1);
    const auto nodes = static_cast<std::size_t>(c.blocks[b].nodes);
    cells.push_back(out.dimension("num_el_in_blk" + number, c.blocks[b].node.size() / nodes));
    lists.push_back(
        out.variable("connect" + number, NC_INT, {cells.back(), out.dimension("num_nod_per_el" + number, nodes)}));
    out.attribute(lists.back(), "elem_type", c.blocks[b].type);
  }
  if (!c.of_points.empty())
    names.push_back(out.variable("name_nod_var", NC_CHAR, {out.dimension("num_nod_var", c.of_points.size()), letters}));
  for (std::size_t v = 0; v < c.of_points.size(); ++v)
    of_points.push_back(out.variable("vals_nod_var" + std::to_string(v + 1), {time, points}));
  if (!c.of_cells.empty())
    names.push_back(
        out.variable("name_elem_var", NC_CHAR, {out.dimension("num_elem_var", c.of_cells.size()), letters}));
  std::vector<std::vector<int>> of_cells(c.of_cells.size());
  for (std::size_t v = 0; v < c.of_cells.size(); ++v)
    for (std::size_t b = 0; b < c.blocks.size(); ++b) {
      const bool absent =
          std::find(c.absent.begin(), c.absent.end(), std::pair(int(v) + 1, int(b) + 1)) != c.absent.end();
      const std::string name = "vals_elem_var" + std::to_string(v + 1) + "eb" + std::to_string(b + 1);
      of_cells[v].push_back(absent ? -1 : out.variable(name, {time, cells[b]}));
    }
  out.finish_header();
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<double> x;
    for (const Vector3& p : c.points) x.push_back(p[a]);
    out.put(axis[a], x);
  }
  std::vector<int> number, present(c.blocks.size(), 1);
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    out.put(lists[b], c.blocks[b].node);
    number.push_back(static_cast<int>(b) + 1);
  }
  out.put(status, present);
  out.put(numbers, number);
  std::size_t name = 0;
  for (const auto* list : {&c.of_points, &c.of_cells})
    if (!list->empty()) out.put_names(names[name++], *list, width);
  const std::size_t steps = std::max(c.point_values.size(), c.cell_values.size());
  for (std::size_t s = 0; s < steps; ++s) {
    out.put_time(time_of, s, 0.5 * double(s));
    for (std::size_t v = 0; v < c.of_points.size(); ++v)
      out.put_step(of_points[v], s, c.point_values[s][v].data(), c.points.size());
    for (std::size_t v = 0; v < c.of_cells.size(); ++v) {
      const double* x = c.cell_values[s][v].data();
      for (std::size_t b = 0; b < c.blocks.size(); ++b) {
        const std::size_t count = c.blocks[b].node.size() / static_cast<std::size_t>(c.blocks[b].nodes);
        if (of_cells[v][b] >= 0) out.put_step(of_cells[v][b], s, x, count);
        x += count;
      }
    }
  }
}

}  // namespace dvrlab::test
