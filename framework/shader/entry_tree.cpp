#include "framework/shader/entry_tree.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <numeric>

#include "framework/scene/buffers.h"

namespace dvrlab {
namespace {

using Faces = std::vector<std::array<std::array<float, 3>, 3>>;

constexpr float margin = 1e-5f;  // sampler coordinates: half the diagonal of a mesh's box is 1
constexpr int leaf_faces = 4;

class TreeBuilder {
 public:
  explicit TreeBuilder(const Faces& faces) : faces_(faces), order_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    add(0, static_cast<int>(faces.size()));
  }
  std::vector<Buffer> take(const std::string& name) {
    // The faces stand behind the nodes, four in an entry.
    const std::uint64_t nodes = node_.size() / 4;
    for (std::size_t k = 0; k < node_.size(); k += 4) node_[k + 3] = static_cast<std::int32_t>(nodes);
    node_.insert(node_.end(), order_.begin(), order_.end());
    node_.resize((node_.size() + 3) / 4 * 4, 0);
    const std::uint64_t entries = node_.size() / 4;
    std::vector<Buffer> buffers;
    buffers.push_back(make_buffer(name + "_box", Element::vec4, std::move(box_), 2 * nodes));
    buffers.push_back(make_buffer(name + "_node", Element::ivec4, std::move(node_), entries));
    return buffers;
  }

 private:
  float centre(int face, std::size_t axis) const {
    const auto& f = faces_[static_cast<std::size_t>(face)];
    return f[0][axis] + f[1][axis] + f[2][axis];
  }
  void add(int begin, int end) {
    const std::size_t node = node_.size();
    float lo[3] = {3e38f, 3e38f, 3e38f}, hi[3] = {-3e38f, -3e38f, -3e38f}, from[3] = {3e38f, 3e38f, 3e38f},
          to[3] = {-3e38f, -3e38f, -3e38f};
    for (int k = begin; k < end; ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        const int face = order_[static_cast<std::size_t>(k)];
        for (const auto& corner : faces_[static_cast<std::size_t>(face)]) {
          lo[a] = std::min(lo[a], corner[a]);
          hi[a] = std::max(hi[a], corner[a]);
        }
        from[a] = std::min(from[a], centre(face, a));
        to[a] = std::max(to[a], centre(face, a));
      }
    box_.insert(box_.end(),
                {lo[0] - margin, lo[1] - margin, lo[2] - margin, 0, hi[0] + margin, hi[1] + margin, hi[2] + margin, 0});
    const bool leaf = end - begin <= leaf_faces;
    node_.insert(node_.end(), {0, begin, leaf ? end - begin : 0, 0});
    if (!leaf) {
      std::size_t axis = 0;
      for (std::size_t a = 1; a < 3; ++a)
        if (to[a] - from[a] > to[axis] - from[axis]) axis = a;
      const int middle = (begin + end) / 2;
      std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
        const float ca = centre(a, axis), cb = centre(b, axis);
        return ca != cb ? ca < cb : a < b;
      });
      add(begin, middle);
      add(middle, end);
    }
    node_[node] = static_cast<std::int32_t>(node_.size() / 4);
  }

  const Faces& faces_;
  std::vector<std::int32_t> order_, node_;
  std::vector<float> box_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

std::shared_ptr<const std::vector<Buffer>> entry_tree_of(const EntrySurface& surface) {
  struct Kept {
    std::weak_ptr<const Faces> faces;
    std::shared_ptr<const std::vector<Buffer>> tree;
  };
  static std::mutex mutex;
  static std::list<Kept> kept;
  const std::lock_guard lock(mutex);
  kept.remove_if([](const Kept& k) { return k.faces.expired(); });
  for (const Kept& k : kept)
    if (k.faces.lock() == surface.faces) return k.tree;
  kept.push_back(
      {surface.faces, std::make_shared<const std::vector<Buffer>>(TreeBuilder(*surface.faces).take(surface.name))});
  return kept.back().tree;
}

std::string entry_declaration(const EntrySurface& surface) {
  return "entry_search entry_next_" + surface.name + "(entry_frame f, vec3 o, vec3 d, entry_search e);\n";
}

std::string entry_definition(const EntrySurface& surface) {
  return replaced(R"(entry_search entry_next_NAME(entry_frame f, vec3 o, vec3 d, entry_search e) {
  vec3 inv = vec3(rcp(away_from_zero(d.x)), rcp(away_from_zero(d.y)), rcp(away_from_zero(d.z)));
  int count = fetchi4_NAME_node(0).x;
  int n = 0;
  while (n < count) {
    vec3 a = (fetch4_NAME_box(2 * n).xyz - o) * inv;
    vec3 b = (fetch4_NAME_box(2 * n + 1).xyz - o) * inv;
    float enter = rmax(rmin(a.x, b.x), rmax(rmin(a.y, b.y), rmin(a.z, b.z)));
    float leave = rmin(rmax(a.x, b.x), rmin(rmax(a.y, b.y), rmax(a.z, b.z)));
    ivec4 node = fetchi4_NAME_node(n);
    if (enter <= leave && leave >= e.from && enter <= e.s) {
      for (int k = 0; k < node.z; ++k) {
        int at = node.y + k;
        ivec4 four = fetchi4_NAME_node(node.w + (at >> 2));
        int face = (at & 3) == 0 ? four.x : (at & 3) == 1 ? four.y : (at & 3) == 2 ? four.z : four.w;
        entry_hit h = NAME_hit(f, o, face);
        if (entry_is_next(e, h, face)) {
          e.s = h.s;
          e.face = face;
        }
      }
      n = n + 1;
    } else {
      n = node.x;
    }
  }
  return e;
}
)",
                  "NAME", surface.name);
}

}  // namespace dvrlab
