// The march of a GPU invocation: one ray. Holes: frame_ray, clip_ray (ray.kernel); stream_start, stream_next, stream_open (steps.glsl
// or walk.glsl, which call the sampler; stream_ready: the round has a segment); segment_integrate (integrate.kernel, which calls the estimator).
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || y >= frame_height) return;
  ray r = frame_ray(float(x), float(y));
  span clipped = clip_ray(r);
  stream_L = clipped.t1 - clipped.t0;
  stream_o = r.grid_o + r.grid_d * clipped.t0;
  stream_d = r.grid_d;
  segment q = segment_of_ray(r.world_o + r.world_d * clipped.t0, r.world_d, stream_L);
  vec3 color = vec3(0.0);
  spectral trans = spectral(1.0);
  int samples = 0, terminated = 0;
  if (stream_L > 0.0) {
    stream_start(x, y);
    while (terminated == 0 && stream_next(q)) {
      if (!stream_ready) continue;
      vec3 c;
      spectral t;
      segment_integrate(q, c, t);
      composite(c, t, color, trans);
      ++samples;
      terminated = ends_ray(trans) ? 1 : 0;
    }
  }
  // Software GPUs end every loop of an invocation once all of them together have made 65535 rounds, without a word, and what
  // comes out is anything. Then this loop makes one round instead of two (its bound is no constant): said, never shown.
  int rounds = 0;
  for (int k = 0; k < imin(frame_width + 1, 2); ++k) ++rounds;
  if (rounds < 2 || (stream_L > 0.0 && terminated == 0 && stream_open())) samples = 0x7f000000;
  int pixel = 2 * ((y - frame_band_y) * frame_width + x);
  dvr_out[pixel] = vec4(over_background(color, trans), uintBitsToFloat(uint(samples)));
  dvr_out[pixel + 1] = vec4(rgb_of(trans), uintBitsToFloat(uint(stream_skipped * 2 + terminated)));
}
