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
walk_state stream_front, stream_walk;  // the segment that is being passed
int stream_part = 0, stream_parts = 0;  // how many of its parts are
bool stream_walking = true;             // the ray is not through
const bool stream_ready = true;         // every round has a segment

void stream_start(int x, int y) { walk_start(stream_o, stream_d, stream_L, stream_walk); }

bool stream_open() { return stream_walking; }

bool stream_next(inout segment q) {
  int kind = 1;
  if (stream_part >= stream_parts) {
    stream_front = stream_walk;
    kind = walk_next(stream_o, stream_d, stream_L, stream_walk);
    // Not do-while: with it, Mesa 22.3's llvmpipe gives lanes that leave the loop early the values of the others.
    while (kind == 2 || (kind == 1 && !(stream_walk.s - stream_front.s > 0.0))) {
      stream_front = stream_walk;
      kind = walk_next(stream_o, stream_d, stream_L, stream_walk);
    }
    stream_part = 0;
    stream_parts = frame_parts != 0 ? parts_of(stream_walk.s - stream_front.s) : 1;
  }
  float s0 = parts_end(stream_front.s, stream_walk.s, stream_part, stream_parts);
  float s1 = parts_end(stream_front.s, stream_walk.s, stream_part + 1, stream_parts);
  float v0 = parts_end(stream_front.v, stream_walk.v, stream_part, stream_parts);
  float v1 = parts_end(stream_front.v, stream_walk.v, stream_part + 1, stream_parts);
  ++stream_part;
  q.len = s1 - s0;
  q.s0 = q.s_prev = s0; q.s1 = q.s_next = s1;
  q.v0 = q.v_prev = v0; q.v1 = q.v_next = v1;
  q.s = 0.5 * (s0 + s1);
  q.v = 0.5 * (v0 + v1);
  q.g0 = q.g1 = q.g = vec3(0.0);
  if (kind == 1 && frame_gradient != 0 && medium_shaded(v0, v1)) {
    q.g0 = walk_gradient(stream_o, stream_d, stream_front, s0);
    q.g1 = walk_gradient(stream_o, stream_d, stream_front, s1);
    q.g = (q.g0 + q.g1) * 0.5;
  }
  if (kind == 1 && frame_lit != 0 && medium_lit(v0, v1)) {
    vec3 m1 = sample_light(stream_o + stream_d * (frame_samples_ends != 0 ? s1 : q.s));
    q = segment_in_light(q, frame_samples_ends != 0 ? sample_light(stream_o + stream_d * s0) : m1, m1);
  }
  stream_walking = kind != 0;
  return kind == 1;
}
