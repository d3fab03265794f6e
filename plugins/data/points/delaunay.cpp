#include "plugins/data/points/delaunay.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "framework/interfaces/error.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace dvrlab::points {
namespace {

/// Qhull writes what is wrong to a file; here to memory.
class Words {
 public:
  Words() : stream_(open_memstream(&text_, &size_)) {}
  ~Words() {
    std::fclose(stream_);
    std::free(text_);
  }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  FILE* stream() { return stream_; }
  /// The first line.
  std::string text() {
    std::fflush(stream_);
    std::string all(text_, size_);
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* stream_;
};

struct Hull {
  qhT state{};
  Hull(FILE* errors) { qh_zero(&state, errors); }
  ~Hull() {
    int left = 0, bytes = 0;
    qh_freeqhull(&state, !qh_ALL);
    qh_memfreeshort(&state, &left, &bytes);
  }
};

}  // namespace

std::vector<std::array<std::uint32_t, 4>> delaunay(const std::vector<Vector3>& points, const std::string& name) {
  if (points.size() < 4)
    throw InputError(name + ": holds " + std::to_string(points.size()) + " points; tetrahedra need at least 4");
  std::vector<coordT> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector3& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  Words words;
  const auto hull = std::make_unique<Hull>(words.stream());
  qhT* qh = &hull->state;
  // d: Delaunay; Qt: tetrahedra also where points lie on a common sphere; Qbb, Qz: scaled, with a point at infinity.
  char options[] = "qhull d Qt Qbb Qc Qz";
  const int code =
      qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False, options, nullptr, words.stream());
  if (code != 0) throw InputError(name + ": Qhull makes no tetrahedra of the points: " + words.text());
  std::vector<std::array<std::uint32_t, 4>> cells;
  for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
    if (facet->upperdelaunay) continue;
    std::array<std::uint32_t, 4> cell{};
    std::size_t n = 0;
    bool real = true;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) {
      const int id = qh_pointid(qh, vertex->point);
      real = real && id >= 0 && static_cast<std::size_t>(id) < points.size() && n < 4;
      if (real) cell[n++] = static_cast<std::uint32_t>(id);
    }
    if (real && n == 4) cells.push_back(cell);
  }
  return cells;
}

}  // namespace dvrlab::points
