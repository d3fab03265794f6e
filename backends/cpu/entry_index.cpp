#include "backends/cpu/entry_index.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <mutex>
#include <stdexcept>

namespace dvrlab::cpu {

struct EntryIndex::Scene {
  std::shared_ptr<const std::vector<std::array<std::array<float, 3>, 3>>> faces;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

/// What a query carries to its callbacks. `Entries` is dvr_entries or dvr_entries64.
template <class Entries>
struct Query {
  RTCIntersectContext context;  // first: Embree hands it back
  Entries* rays;
  bool packed;  // dvr_entries64 or dvr_entries: the callback must know
};

/// Sampler coordinates: half the diagonal of a mesh's box is 1, and a ray starts inside the box.
constexpr float margin = 1e-5f;

void face_bounds(const RTCBoundsFunctionArguments* a) {
  const auto& faces = *static_cast<const std::vector<std::array<std::array<float, 3>, 3>>*>(a->geometryUserPtr);
  const auto& f = faces[a->primID];
  float lo[3], hi[3];
  for (std::size_t k = 0; k < 3; ++k) {
    lo[k] = std::min({f[0][k], f[1][k], f[2][k]}) - margin;
    hi[k] = std::max({f[0][k], f[1][k], f[2][k]}) + margin;
  }
  RTCBounds& b = *a->bounds_o;
  b.lower_x = lo[0];
  b.lower_y = lo[1];
  b.lower_z = lo[2];
  b.upper_x = hi[0];
  b.upper_y = hi[1];
  b.upper_z = hi[2];
}

/// Behind it nothing needs to be looked for: a face at the same place may still come first by its index.
template <class Real>
float far_end(Real s, Real from) {
  if (s > Real(1e38)) return std::numeric_limits<float>::infinity();
  const auto t = static_cast<float>(s - from);
  return t + std::abs(t) * 1e-5f + 1e-30f;
}

template <class Entries>
void try_face(const RTCIntersectFunctionNArguments* a, Entries* rays) {
  int on[DVR_MAX_WIDTH];
  std::copy(rays->on, rays->on + rays->width, on);
  std::fill(rays->on, rays->on + rays->width, 0);
  RTCRayN* ray = RTCRayHitN_RayN(a->rayhit, a->N);
  for (unsigned i = 0; i < a->N; ++i)
    if (a->valid[i] != 0) rays->on[RTCRayN_id(ray, a->N, i)] = 1;
  rays->try_face(rays->kernel, rays, static_cast<int>(a->primID));
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const unsigned lane = RTCRayN_id(ray, a->N, i);
    RTCRayN_tfar(ray, a->N, i) = far_end(rays->s[lane], rays->from[lane]);
  }
  std::copy(on, on + rays->width, rays->on);
}

void face_intersect(const RTCIntersectFunctionNArguments* a) {
  const auto* query = reinterpret_cast<const Query<dvr_entries>*>(a->context);
  if (query->packed)
    try_face(a, query->rays);
  else
    try_face(a, reinterpret_cast<const Query<dvr_entries64>*>(a->context)->rays);
}

/// The ray of one lane, from where its search begins.
template <class Entries, class SetRay>
void set_ray(const Entries& r, int lane, SetRay set) {
  float o[3], d[3];
  for (int k = 0; k < 3; ++k) {
    o[k] = static_cast<float>(r.o[k][lane] + r.d[k][lane] * r.from[lane]);
    d[k] = static_cast<float>(r.d[k][lane]);
  }
  set(o, d);
}

template <class Packet>
void fill_lane(Packet& p, int i, const float* o, const float* d, unsigned id) {
  p.ray.org_x[i] = o[0];
  p.ray.org_y[i] = o[1];
  p.ray.org_z[i] = o[2];
  p.ray.dir_x[i] = d[0];
  p.ray.dir_y[i] = d[1];
  p.ray.dir_z[i] = d[2];
  p.ray.tnear[i] = 0;
  p.ray.tfar[i] = std::numeric_limits<float>::infinity();
  p.ray.time[i] = 0;
  p.ray.mask[i] = ~0u;
  p.ray.id[i] = id;
  p.ray.flags[i] = 0;
  p.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
}

template <class Packet, int N>
void find_packet(RTCScene scene, dvr_entries* rays,
                 void (*intersect)(const int*, RTCScene, RTCIntersectContext*, Packet*)) {
  alignas(64) int valid[N];
  alignas(64) Packet p;
  for (int i = 0; i < N; ++i) {
    valid[i] = rays->on[i] != 0 ? -1 : 0;
    set_ray(*rays, i, [&](const float* o, const float* d) { fill_lane(p, i, o, d, static_cast<unsigned>(i)); });
  }
  Query<dvr_entries> query;
  rtcInitIntersectContext(&query.context);
  query.rays = rays;
  query.packed = true;
  intersect(valid, scene, &query.context, &p);
}

template <class Entries>
void find_one(RTCScene scene, Entries* rays, int lane) {
  alignas(16) RTCRayHit p{};
  set_ray(*rays, lane, [&](const float* o, const float* d) {
    p.ray.org_x = o[0];
    p.ray.org_y = o[1];
    p.ray.org_z = o[2];
    p.ray.dir_x = d[0];
    p.ray.dir_y = d[1];
    p.ray.dir_z = d[2];
  });
  p.ray.tfar = std::numeric_limits<float>::infinity();
  p.ray.mask = ~0u;
  p.ray.id = static_cast<unsigned>(lane);
  p.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Query<Entries> query;
  rtcInitIntersectContext(&query.context);
  query.rays = rays;
  query.packed = std::is_same_v<Entries, dvr_entries>;
  rtcIntersect1(scene, &query.context, &p);
}

[[noreturn]] void fail(RTCDevice device, const char* what) {
  const RTCError code = rtcGetDeviceError(device);
  throw std::runtime_error(std::string("backend cpu: Embree ") + what + " (error " + std::to_string(int(code)) + ")");
}

}  // namespace

EntryIndex::EntryIndex(const EntrySurface& surface) : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  s.faces = surface.faces;
  s.device = rtcNewDevice("set_affinity=0");
  if (s.device == nullptr) fail(nullptr, "does not start");
  s.scene = rtcNewScene(s.device);
  rtcSetSceneBuildQuality(s.scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(s.faces->size()));
  rtcSetGeometryUserData(geometry, const_cast<void*>(static_cast<const void*>(s.faces.get())));
  rtcSetGeometryBoundsFunction(geometry, face_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, face_intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(s.scene);
  if (rtcGetDeviceError(s.device) != RTC_ERROR_NONE) fail(s.device, "cannot build the hierarchy of a mesh's boundary");
}
EntryIndex::~EntryIndex() = default;

void EntryIndex::find(const void* index, dvr_entries* rays) {
  RTCScene scene = static_cast<const EntryIndex*>(index)->scene_->scene;
  if (rays->width == 16)
    find_packet<RTCRayHit16, 16>(scene, rays, rtcIntersect16);
  else if (rays->width == 8)
    find_packet<RTCRayHit8, 8>(scene, rays, rtcIntersect8);
  else if (rays->width == 4)
    find_packet<RTCRayHit4, 4>(scene, rays, rtcIntersect4);
  else
    for (int l = 0; l < rays->width; ++l)
      if (rays->on[l] != 0) find_one(scene, rays, l);
}

void EntryIndex::find64(const void* index, dvr_entries64* rays) {
  for (int l = 0; l < rays->width; ++l)
    if (rays->on[l] != 0) find_one(static_cast<const EntryIndex*>(index)->scene_->scene, rays, l);
}

std::shared_ptr<const EntryIndex> entry_index_of(const EntrySurface& surface) {
  using Faces = std::vector<std::array<std::array<float, 3>, 3>>;
  struct Kept {
    std::weak_ptr<const Faces> faces;
    std::shared_ptr<const EntryIndex> index;
  };
  static std::mutex mutex;
  static std::list<Kept> kept;
  const std::lock_guard lock(mutex);
  // An index holds its surface's faces itself: what nobody else holds goes.
  kept.remove_if([](const Kept& k) { return k.faces.use_count() <= 1; });
  for (const Kept& k : kept)
    if (k.faces.lock() == surface.faces) return k.index;
  kept.push_back({surface.faces, std::make_shared<EntryIndex>(surface)});
  return kept.back().index;
}

}  // namespace dvrlab::cpu
