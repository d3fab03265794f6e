#include "plugins/estimator/preintegrated/table_request.h"

#include <algorithm>
#include <string>

#include "framework/interfaces/error.h"

namespace dvrlab::preintegrated {

namespace {
using Kind = OutputChannel::Kind;
[[noreturn]] void refuse(const std::string& why) { throw InputError("pre-integration table: " + why); }
}  // namespace

int TableRequest::moments(int column) const {
  int most = 0;
  for (const OutputChannel& o : outputs) {
    if (o.index != column) continue;
    if (o.kind == Kind::back) most = std::max(most, 1);
    if (o.kind == Kind::second || o.kind == Kind::third) most = 3;
  }
  return most;
}

void check(const TableRequest& r) {
  const int columns = static_cast<int>(r.columns.size()), outputs = static_cast<int>(r.outputs.size());
  if (columns < 1 || columns > most_columns)
    refuse(std::to_string(columns) + " source columns are asked for; 1 to " + std::to_string(most_columns) +
           " are possible");
  if (outputs < 4 || outputs % 4 != 0 || r.groups() > most_groups)
    refuse(std::to_string(outputs) + " channels are asked for; they come in groups of 4, 1 to " +
           std::to_string(most_groups) + " groups");
  for (const SourceColumn& c : r.columns)
    if (c.channel < 0 || c.channel > 2)
      refuse("a source column names the colour channel " + std::to_string(c.channel) + "; there are 0, 1 and 2");
  for (const OutputChannel& o : r.outputs) {
    if (o.kind == Kind::zero) continue;
    const int most = o.kind == Kind::transmittance ? r.extinctions() : columns;
    if (o.index < 0 || o.index >= most)
      refuse("a channel names the " + std::string(o.kind == Kind::transmittance ? "extinction" : "source column") +
             " " + std::to_string(o.index) + "; there are " + std::to_string(most));
    if (r.ratio && o.kind == Kind::transmittance)
      refuse("a ratio table holds no transmittance; it is exact from the one-dimensional tables");
  }
}

}  // namespace dvrlab::preintegrated
