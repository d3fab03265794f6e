#include "plugins/data/exodus/exodus_file.h"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "framework/interfaces/error.h"

namespace dvrlab::exodus {
namespace {

constexpr std::uint64_t most_blocks = 100000, most_variables = 10000, longest_name = 65536;

std::string numbered(const char* name, int number) { return name + std::to_string(number); }

/// The library has negative numbers for its own errors. A positive one is of the system, and means little here: bytes
/// that are not there are "Operation not permitted".
std::string reason(int error) { return error > 0 ? "the file is cut off or damaged" : nc_strerror(error); }

}  // namespace

void ExodusFile::fail(const std::string& what) const { throw InputError(name_ + ": " + what); }
void ExodusFile::fail_at(const std::string& variable, int error) const {
  fail("variable \"" + variable + "\" cannot be read: " + reason(error));
}

ExodusFile::ExodusFile(std::span<const std::byte> bytes, std::string name)
    : name_(std::move(name)), bytes_(bytes.size()) {
  // The library only reads with NC_NOWRITE; its signature has no const.
  const int error = nc_open_mem(name_.c_str(), NC_NOWRITE, bytes.size(), const_cast<std::byte*>(bytes.data()), &id_);
  if (error != NC_NOERR) {
    id_ = -1;
    fail("is no netCDF file that can be read: " + reason(error));
  }
  try {
    constexpr std::uint64_t none = 0;
    points_ = length("num_nodes", none);
    if (points_ == none || length("num_el_blk", none) == none)
      fail("is a netCDF file without the points and blocks of Exodus II (dimensions num_nodes, num_el_blk)");
    const std::uint64_t axes = length("num_dim", none);
    if (axes != 3) fail("is of " + std::to_string(axes) + " dimensions; a volume has 3");
    steps_ = length("time_step", none);
    read_blocks();
    read_variables();
  } catch (...) {
    nc_close(id_);
    throw;
  }
}

ExodusFile::~ExodusFile() { nc_close(id_); }

std::uint64_t ExodusFile::length(const std::string& dimension, std::uint64_t missing) const {
  int id = 0;
  std::size_t n = 0;
  if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR || nc_inq_dimlen(id_, id, &n) != NC_NOERR) return missing;
  return n;
}

bool ExodusFile::has(const std::string& variable) const {
  int id = 0;
  return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

int ExodusFile::find(const std::string& variable, const std::vector<std::uint64_t>& shape, bool steps) const {
  int id = 0, count = 0, dimension[NC_MAX_VAR_DIMS];
  if (nc_inq_varid(id_, variable.c_str(), &id) != NC_NOERR) fail("has no variable \"" + variable + "\"");
  if (nc_inq_varndims(id_, id, &count) != NC_NOERR || count != static_cast<int>(shape.size()) ||
      nc_inq_vardimid(id_, id, dimension) != NC_NOERR)
    fail("variable \"" + variable + "\" has " + std::to_string(count) + " dimensions; it needs " +
         std::to_string(shape.size()));
  for (std::size_t k = 0; k < shape.size(); ++k) {
    std::size_t n = 0;
    nc_inq_dimlen(id_, dimension[k], &n);
    if (n != shape[k] && !(steps && k == 0 && n > shape[k]))
      fail("variable \"" + variable + "\" has " + std::to_string(n) + " entries along dimension " + std::to_string(k) +
           "; it needs " + std::to_string(shape[k]));
  }
  return id;
}

std::vector<double> ExodusFile::numbers(const std::string& variable, std::uint64_t count) const {
  const int id = find(variable, {count}, false);
  std::vector<double> x(count);
  if (const int error = nc_get_var_double(id_, id, x.data())) fail_at(variable, error);
  return x;
}

std::vector<double> ExodusFile::numbers_at(const std::string& variable, std::uint64_t step, std::uint64_t count) const {
  const int id = find(variable, {step + 1, count}, true);
  std::vector<double> x(count);
  const std::size_t from[] = {step, 0}, size[] = {1, count};
  if (const int error = nc_get_vara_double(id_, id, from, size, x.data())) fail_at(variable, error);
  return x;
}

// A row per name, padded with zeros or blanks; how long rows are is the file's own choice.
std::vector<std::string> ExodusFile::names(const std::string& variable, const std::string& dimension) const {
  const std::uint64_t count = length(dimension, 0);
  if (count == 0) return {};
  int id = 0, dimensions = 0, of[NC_MAX_VAR_DIMS];
  std::size_t width = 0;
  if (nc_inq_varid(id_, variable.c_str(), &id) != NC_NOERR) fail("has no variable \"" + variable + "\"");
  if (nc_inq_varndims(id_, id, &dimensions) != NC_NOERR || dimensions != 2 ||
      nc_inq_vardimid(id_, id, of) != NC_NOERR || nc_inq_dimlen(id_, of[1], &width) != NC_NOERR)
    fail("variable \"" + variable + "\" is no list of names");
  find(variable, {count, width}, false);
  if (count > most_variables || width > longest_name)
    fail("variable \"" + variable + "\" lists " + std::to_string(count) + " names of " + std::to_string(width) +
         " letters; at most " + std::to_string(most_variables) + " of " + std::to_string(longest_name) + " are read");
  std::vector<std::string> list;
  std::string row(width, '\0');
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from[] = {k, 0}, size[] = {1, width};
    if (const int error = nc_get_vara_text(id_, id, from, size, row.data())) fail_at(variable, error);
    std::string word = row.substr(0, row.find('\0'));
    word.erase(word.find_last_not_of(' ') + 1);
    list.push_back(word);
  }
  return list;
}

void ExodusFile::read_blocks() {
  const std::uint64_t count = length("num_el_blk", 0);
  if (count > most_blocks)
    fail("has " + std::to_string(count) + " blocks of cells; at most " + std::to_string(most_blocks) + " are read");
  for (int k = 1; k <= static_cast<int>(count); ++k) {
    Block b{k, "", length(numbered("num_el_in_blk", k), 0), length(numbered("num_nod_per_el", k), 0)};
    if (b.cells == 0) continue;  // an empty block has no variables
    const std::string list = numbered("connect", k);
    const int id = find(list, {b.cells, b.nodes}, false);
    std::size_t letters = 0;
    if (nc_inq_attlen(id_, id, "elem_type", &letters) != NC_NOERR || letters > longest_name)
      fail("variable \"" + list + "\" does not say its type of cells (attribute elem_type)");
    b.type.resize(letters);
    if (const int error = nc_get_att_text(id_, id, "elem_type", b.type.data())) fail_at(list, error);
    b.type = b.type.substr(0, b.type.find('\0'));
    std::transform(b.type.begin(), b.type.end(), b.type.begin(), [](unsigned char c) { return std::toupper(c); });
    blocks_.push_back(b);
  }
}

void ExodusFile::read_variables() {
  if (steps_ == 0) return;
  int number = 0;
  for (const std::string& name : names("name_nod_var", "num_nod_var")) variables_.push_back({name, ++number, false});
  number = 0;
  for (const std::string& name : names("name_elem_var", "num_elem_var")) {
    ++number;
    bool everywhere = true;
    for (const Block& b : blocks_)
      everywhere = everywhere && has(numbered("vals_elem_var", number) + numbered("eb", b.number));
    if (everywhere) variables_.push_back({name, number, true});
  }
}

std::vector<double> ExodusFile::places() const {
  std::vector<double> place(3 * points_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> x = numbers(std::string("coord") + "xyz"[axis], points_);
    for (std::size_t k = 0; k < points_; ++k) place[3 * k + axis] = x[k];
  }
  return place;
}

std::vector<std::int64_t> ExodusFile::connectivity(const Block& b) const {
  const std::string list = numbered("connect", b.number);
  const int id = find(list, {b.cells, b.nodes}, false);
  std::vector<long long> node(b.cells * b.nodes);
  if (const int error = nc_get_var_longlong(id_, id, node.data())) fail_at(list, error);
  std::vector<std::int64_t> from0(node.size());
  for (std::size_t k = 0; k < node.size(); ++k) {
    if (node[k] < 1 || static_cast<std::uint64_t>(node[k]) > points_)
      fail("variable \"" + list + "\" names the point " + std::to_string(node[k]) + " of " + std::to_string(points_));
    from0[k] = node[k] - 1;
  }
  return from0;
}

std::vector<double> ExodusFile::values(const Variable& v, std::uint64_t step) const {
  if (!v.cells) {
    const std::string own = numbered("vals_nod_var", v.number);
    return numbers_at(own, step, points_);
  }
  std::vector<double> all;
  for (const Block& b : blocks_) {
    const std::vector<double> x =
        numbers_at(numbered("vals_elem_var", v.number) + numbered("eb", b.number), step, b.cells);
    all.insert(all.end(), x.begin(), x.end());
  }
  return all;
}

double ExodusFile::time(std::uint64_t step) const {
  const int id = find("time_whole", {step + 1}, true);
  double t = 0;
  const std::size_t at = step;
  if (const int error = nc_get_var1_double(id_, id, &at, &t)) fail_at("time_whole", error);
  return t;
}

}  // namespace dvrlab::exodus
