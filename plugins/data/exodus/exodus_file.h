// What an Exodus II file holds: points, blocks of cells, variables of both over time. Numbers are read when asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dvrlab::exodus {

/// A variable as it is named: one number per point or cell and time step.
struct Variable {
  std::string name;
  int number = 0;  // from 1, as the file counts them
  bool cells = false;
};

/// Cells of one type.
struct Block {
  int number = 0;                      // from 1
  std::string type;                    // in capitals: "HEX", "TETRA10", ...
  std::uint64_t cells = 0, nodes = 0;  // nodes of each cell
};

/// An open file. Every function throws InputError, the file's name in front, for what is not there or has another size.
class ExodusFile {
 public:
  /// `bytes` must outlive it.
  ExodusFile(std::span<const std::byte> bytes, std::string name);
  ~ExodusFile();
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  std::uint64_t points() const { return points_; }
  std::uint64_t steps() const { return steps_; }  // of time; 0: the file holds no values
  const std::vector<Block>& blocks() const { return blocks_; }
  /// Of the points, and of the cells those that every block has.
  const std::vector<Variable>& variables() const { return variables_; }

  std::vector<double> places() const;                            // x, y, z of each point
  std::vector<std::int64_t> connectivity(const Block& b) const;  // points from 0, cell by cell
  /// Of all points, or of all cells, block after block.
  std::vector<double> values(const Variable& v, std::uint64_t step) const;
  double time(std::uint64_t step) const;

 private:
  /// The length of a dimension, or `missing`.
  std::uint64_t length(const std::string& dimension, std::uint64_t missing) const;
  bool has(const std::string& variable) const;
  /// The variable's id; its dimensions must have these lengths; the first may be longer where `steps`.
  int find(const std::string& variable, const std::vector<std::uint64_t>& shape, bool steps) const;
  std::vector<double> numbers(const std::string& variable, std::uint64_t count) const;
  std::vector<double> numbers_at(const std::string& variable, std::uint64_t step, std::uint64_t count) const;
  std::vector<std::string> names(const std::string& variable, const std::string& dimension) const;
  void read_blocks();
  void read_variables();
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_at(const std::string& variable, int error) const;

  std::string name_;
  std::uint64_t bytes_ = 0;
  int id_ = -1;
  std::uint64_t points_ = 0, steps_ = 0;
  std::vector<Block> blocks_;
  std::vector<Variable> variables_;
};

}  // namespace dvrlab::exodus
