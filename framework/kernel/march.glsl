// The march of a GPU invocation: one ray. The CPU runs the same functions in chunks (framework/kernel/cpu).
// Holes: frame_ray, clip_ray (ray.kernel); sample_value, sample_gradient (the sampler); segment_kernel (the estimator).
layout(local_size_x = 8, local_size_y = 8) in;

float row_position(int i, int n, float L, float offset) {
  return frame_samples_ends != 0 ? steps_end(i, n, L, offset) : steps_centre(i, n, L, offset);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || y >= frame_height) return;
  ray r = frame_ray(float(x), float(y));
  span clipped = clip_ray(r);
  float L = clipped.t1 - clipped.t0;
  vec3 go = r.grid_o + r.grid_d * clipped.t0;
  segment q;
  q.world_o = r.world_o + r.world_d * clipped.t0;
  q.world_d = r.world_d;
  q.inv_L = rcp(rmax(L, 1e-30));
  float offset = frame_jitter_on != 0 ? jitter_offset(x, y) : 0.0;
  int n = L > 0.0 ? steps_count(L, offset) : 0;
  vec3 color = vec3(0.0);
  spectral trans = spectral(1.0);
  int samples = 0, skipped = 0, terminated = 0;
  int i = 0;
  int until_check = 0;   // segments until the next look at the macrocells
  bool carried = false;  // rows b and c hold the front neighbour and this sample already
  float s_a = 0.0, v_a = 0.0, s_b = 0.0, v_b = 0.0, s_c = 0.0, v_c = 0.0;
  while (i < n) {
    if (frame_skip != 0 && until_check == 0) {
      int next = steps_leap(i, n, L, offset, go, r.grid_d);
      if (next > i) {
        skipped += next - i;
        i = next;
        carried = false;
        continue;
      }
      until_check = 8;
    }
    --until_check;
    // The rows that the CPU keeps in its chunk: `centre` (prev, this, next), `ends` (-, front, back).
    if (carried) {
      s_a = s_b; v_a = v_b;
      s_b = s_c; v_b = v_c;
    } else {
      s_b = row_position(i, n, L, offset);
      v_b = sample_value(go + r.grid_d * s_b);
      if (frame_neighbours != 0) {
        s_a = steps_centre(i - 1, n, L, offset);
        v_a = sample_value(go + r.grid_d * s_a);
      }
    }
    if (frame_neighbours != 0 || frame_samples_ends != 0) {
      s_c = row_position(i + 1, n, L, offset);
      v_c = sample_value(go + r.grid_d * s_c);
      carried = true;
    }
    q.len = steps_length(i, n, L, offset);
    q.s0 = s_b; q.s1 = s_c; q.v0 = v_b; q.v1 = v_c;
    q.s_prev = s_a; q.s = s_b; q.s_next = s_c;
    q.v_prev = v_a; q.v = v_b; q.v_next = v_c;
    q.g0 = q.g1 = q.g = vec3(0.0);
    if (frame_gradient != 0) {
      if (frame_samples_ends != 0) {
        if (medium_shaded(v_b, v_c)) {
          q.g0 = sample_gradient(go + r.grid_d * s_b);
          q.g1 = sample_gradient(go + r.grid_d * s_c);
        }
      } else if (medium_shaded(v_b, v_b)) {
        q.g = sample_gradient(go + r.grid_d * s_b);
      }
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
    ++i;
  }
  int pixel = 2 * ((y - frame_band_y) * frame_width + x);
  dvr_out[pixel] = vec4(over_background(color, trans), uintBitsToFloat(uint(samples)));
  dvr_out[pixel + 1] = vec4(rgb_of(trans), uintBitsToFloat(uint(skipped * 2 + terminated)));
}
