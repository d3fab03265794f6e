// The stream of segments of a GPU invocation for a positional sampler: it is asked at the positions of steps.kernel.
// The CPU fills chunks with the same functions (framework/kernel/cpu/sampler_variant.h).
int stream_i = 0, stream_n = 0, until_check = 0;  // until_check: segments until the next look at the macrocells
bool carried = false;                             // rows b and c hold the front neighbour and this sample already
float stream_offset = 0.0, s_b = 0.0, v_b = 0.0, s_c = 0.0, v_c = 0.0;

float row_position(int i) {
  return frame_samples_ends != 0 ? steps_end(i, stream_n, stream_L, stream_offset)
                                 : steps_centre(i, stream_n, stream_L, stream_offset);
}
float value_at(float s) { return sample_value(stream_o + stream_d * s); }
vec3 gradient_at(float s) { return sample_gradient(stream_o + stream_d * s); }

void stream_start(int x, int y) {
  if (frame_jitter_on != 0) stream_offset = jitter_offset(x, y);
  stream_n = steps_count(stream_L, stream_offset);
}

// True while segments are left: a march that ends with some left was cut by the driver.
bool stream_open() { return stream_i < stream_n; }

bool stream_next(inout segment q) {
  while (frame_skip != 0 && until_check == 0 && stream_i < stream_n) {
    int next = steps_leap(stream_i, stream_n, stream_L, stream_offset, stream_o, stream_d);
    if (next == stream_i) {
      until_check = 8;
    } else {
      stream_skipped += next - stream_i;
      stream_i = next;
      carried = false;
    }
  }
  if (stream_i >= stream_n) return false;
  --until_check;
  // The rows that the CPU keeps in its chunk: `centre` (prev, this, next), `ends` (-, front, back).
  float s_a = s_b, v_a = v_b;
  if (carried) {
    s_b = s_c; v_b = v_c;
  } else {
    s_b = row_position(stream_i);
    v_b = value_at(s_b);
    if (frame_neighbours != 0) {
      s_a = steps_centre(stream_i - 1, stream_n, stream_L, stream_offset);
      v_a = value_at(s_a);
    }
  }
  if (frame_neighbours != 0 || frame_samples_ends != 0) {
    s_c = row_position(stream_i + 1);
    v_c = value_at(s_c);
    carried = true;
  }
  q.len = steps_length(stream_i, stream_n, stream_L, stream_offset);
  q.s_prev = s_a; q.s0 = q.s = s_b; q.s1 = q.s_next = s_c;
  q.v_prev = v_a; q.v0 = q.v = v_b; q.v1 = q.v_next = v_c;
  q.g0 = q.g1 = q.g = vec3(0.0);
  if (frame_gradient != 0 && medium_shaded(v_b, frame_samples_ends != 0 ? v_c : v_b)) {
    q.g0 = q.g = gradient_at(s_b);
    if (frame_samples_ends != 0) q.g1 = gradient_at(s_c);
  }
  ++stream_i;
  return true;
}
