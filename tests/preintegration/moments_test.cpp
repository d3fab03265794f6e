// Tables for light factors that are cubics of the position: C_0 .. C_3 (docs/math B.7).
#include <gtest/gtest.h>

#include <string>

#include "plugins/estimator/preintegrated/definition.h"
#include "tests/preintegration/media.h"
#include "tests/support/golden_case.h"

namespace dvrlab::test {
namespace {

// The moments C_0 .. C_3 of the golden file, as composed from the cells of a fine table.
TEST(NonlinearGradientTables, MomentsAreGolden) {
  using namespace dvrlab::preintegrated;
  const nlohmann::json g = golden_case("est_absem_down");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  constexpr int n = 6001;  // 0.7 and 0.1 are grid values
  const Cells cells = integrate_cells(golden_medium(g), {n, 0, 1});
  for (int c = 0; c < 3; ++c) {
    SourceColumn source;
    source.P = source.E = true;
    source.channel = c;
    const Entry e = defined_entry(cells, source, c, 0.4, 4200, 600, 1);
    const double found[4] = {e.C, e.B, e.second, e.third};
    for (int k = 0; k < 4; ++k) {
      const std::string key = "nlgrad_C" + std::to_string(k);
      EXPECT_NEAR(found[k], std::stod(g["expect"][key][std::size_t(c)].get<std::string>()), 1e-7) << key << " " << c;
    }
  }
}

}  // namespace
}  // namespace dvrlab::test
