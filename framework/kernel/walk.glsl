// The march of a GPU invocation for a walking sampler: segments end at the faces of its cells. The CPU runs the same
// functions in chunks (framework/kernel/cpu/walker_variant.h). The sampler's kernel text defines
//   struct walk_state            real s, real v: the current sample; beside them what the walk needs, real and inti only
//   void walk_start(vec3r o, vec3r d, real L, OUT(walk_state) w)
//                                the first sample of the ray o + s d, 0 <= s <= L (sampler coordinates)
//   inti walk_next(vec3r o, vec3r d, real L, INOUT(walk_state) w)
//                                1: moved to the next sample through matter, 2: through a gap, 0: the ray is through
//   vec3r walk_gradient(vec3r o, vec3r d, walk_state w)
//                                the world gradient at the current sample, continuous along the ray
// The scalar is linear between two samples. A segment of length 0 counts as a gap.
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || y >= frame_height) return;
  ray r = frame_ray(float(x), float(y));
  span clipped = clip_ray(r);
  float L = clipped.t1 - clipped.t0;
  vec3 o = r.grid_o + r.grid_d * clipped.t0;
  vec3 d = r.grid_d;
  segment q;
  q.world_o = r.world_o + r.world_d * clipped.t0;
  q.world_d = r.world_d;
  q.inv_L = rcp(rmax(L, 1e-30));
  vec3 color = vec3(0.0);
  spectral trans = spectral(1.0);
  int samples = 0, terminated = 0;
  if (L > 0.0) {
    walk_state w;
    walk_start(o, d, L, w);
    while (true) {
      walk_state front = w;
      int kind = walk_next(o, d, L, w);
      if (kind == 0) break;
      q.len = w.s - front.s;
      if (kind != 1 || !(q.len > 0.0)) continue;
      q.s0 = q.s_prev = front.s; q.s1 = q.s_next = w.s;
      q.v0 = q.v_prev = front.v; q.v1 = q.v_next = w.v;
      q.s = 0.5 * (front.s + w.s);
      q.v = 0.5 * (front.v + w.v);
      q.g0 = q.g1 = q.g = vec3(0.0);
      if (frame_gradient != 0 && medium_shaded(front.v, w.v)) {
        q.g0 = walk_gradient(o, d, front);
        q.g1 = walk_gradient(o, d, w);
        q.g = (q.g0 + q.g1) * 0.5;
      }
      vec3 c;
      spectral t;
      segment_kernel(q, c, t);
      composite(c, t, color, trans);
      ++samples;
      if (ends_ray(trans)) {
        terminated = 1;
        break;
      }
    }
  }
  int pixel = 2 * ((y - frame_band_y) * frame_width + x);
  dvr_out[pixel] = vec4(over_background(color, trans), uintBitsToFloat(uint(samples)));
  dvr_out[pixel + 1] = vec4(rgb_of(trans), uintBitsToFloat(uint(terminated)));
}
