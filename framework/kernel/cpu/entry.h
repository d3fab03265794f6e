// The word ENTRY(name) and entry_next(name, ...) of walking samplers (not guarded): a surface whose faces the backend
// finds and the kernel's text judges. Inside the walker's struct.

KFN static void store_entries(ray_entries* r, entry_frame f, vec3r o, vec3r d, entry_search e, mask on) {
  dvr::store3(r->o, o);
  dvr::store3(r->d, d);
  dvr::store3(r->axes, f.across);
  dvr::store3(r->axes + 3, f.up);
  dvr::store3(r->axes + 6, f.along);
  store(r->from, e.from);
  store(r->after, e.after);
  store(r->after_face, e.after_face);
  store(r->s, e.s);
  store(r->face, e.face);
  store(r->on, select(on, I(1), I(0)));
  r->width = W;
}
KFN static entry_search search_of(const ray_entries* r) {
  entry_search e;
  e.from = load(r->from);
  e.after = load(r->after);
  e.after_face = load(r->after_face);
  e.s = load(r->s);
  e.face = load(r->face);
  return e;
}
KFN static entry_frame frame_of(const ray_entries* r) {
  return {load3(r->axes), load3(r->axes + 3), load3(r->axes + 6)};
}

// The text behind it defines entry_hit name_hit(entry_frame f, vec3r o, inti face).
#define ENTRY(name)                                                              \
  dvr_entry_surface name = this->surface(#name);                                 \
  static void name##_try(void* kernel, ray_entries* r, int face) {               \
    DVR_STRUCT* self = static_cast<DVR_STRUCT*>(kernel);                         \
    const entry_search e = search_of(r);                                         \
    const entry_hit h = self->name##_hit(frame_of(r), load3(r->o), I(face));     \
    const mask next = load(r->on) == I(1) && self->entry_is_next(e, h, I(face)); \
    store(r->s, select(next, h.s, e.s));                                         \
    store(r->face, select(next, I(face), e.face));                               \
  }
#define entry_next(name, f, o, d, e, on) this->find_entry(name, &DVR_STRUCT::name##_try, f, o, d, e, on)

KFN entry_search find_entry(const dvr_entry_surface& surface, void (*try_face)(void*, ray_entries*, int), entry_frame f,
                            vec3r o, vec3r d, entry_search e, mask on) {
  ray_entries rays;
  store_entries(&rays, f, o, d, e, on);
  rays.kernel = this;
  rays.try_face = try_face;
#ifdef DVR_ISA_fp64
  surface.find64(surface.index, &rays);
#else
  surface.find(surface.index, &rays);
#endif
  e.s = load(rays.s);
  e.face = load(rays.face);
  return e;
}
