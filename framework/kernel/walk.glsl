// The stream of segments of a GPU invocation for a walking sampler: segments end at the faces of its cells. The CPU runs
// the same functions in chunks (framework/kernel/cpu/walker_variant.h). The sampler's kernel text defines
//   struct walk_state            real s, real v: the current sample; beside them what the walk needs, real and inti only
//   void walk_start(vec3r o, vec3r d, real L, OUT(walk_state) w)
//                                the first sample of the ray o + s d, 0 <= s <= L (sampler coordinates)
//   inti walk_next(vec3r o, vec3r d, real L, INOUT(walk_state) w)
//                                1: moved to the next sample through matter, 2: through a gap, 0: the ray is through
//   vec3r walk_gradient(vec3r o, vec3r d, walk_state w, real s)
//                                the world gradient at s in the cell ahead of w; it may jump from cell to cell
// The scalar is linear between two samples. A segment of length 0 counts as a gap.
walk_state stream_walk;
bool stream_walking = true;      // the ray is not through
const bool stream_ready = true;  // every round has a segment

void stream_start(int x, int y) { walk_start(stream_o, stream_d, stream_L, stream_walk); }

bool stream_open() { return stream_walking; }

bool stream_next(inout segment q) {
  walk_state front = stream_walk;
  int kind = walk_next(stream_o, stream_d, stream_L, stream_walk);
  q.len = stream_walk.s - front.s;
  // Not do-while: with it, Mesa 22.3's llvmpipe gives lanes that leave the loop early the values of the others.
  while (kind == 2 || (kind == 1 && !(q.len > 0.0))) {
    front = stream_walk;
    kind = walk_next(stream_o, stream_d, stream_L, stream_walk);
    q.len = stream_walk.s - front.s;
  }
  q.s0 = q.s_prev = front.s; q.s1 = q.s_next = stream_walk.s;
  q.v0 = q.v_prev = front.v; q.v1 = q.v_next = stream_walk.v;
  q.s = 0.5 * (front.s + stream_walk.s);
  q.v = 0.5 * (front.v + stream_walk.v);
  q.g0 = q.g1 = q.g = vec3(0.0);
  if (kind == 1 && frame_gradient != 0 && medium_shaded(front.v, stream_walk.v)) {
    q.g0 = walk_gradient(stream_o, stream_d, front, front.s);
    q.g1 = walk_gradient(stream_o, stream_d, front, stream_walk.s);
    q.g = (q.g0 + q.g1) * 0.5;
  }
  stream_walking = kind != 0;
  return kind == 1;
}
