// The stream of segments of a GPU invocation for a positional sampler: it is asked at the positions of steps.kernel.
// The CPU fills chunks with the same functions (framework/kernel/cpu/sampler_variant.h).
// Every round takes one sample, and a segment is there once its rows are: `centre` 1, with neighbours 3 (before, this,
// next), `ends` 2 (front, back). So the sampler stands in the loop once; GPUs without jumps, software GPUs among them, run
// every copy of it in every round.
int stream_i = 0, stream_n = 0, until_check = 0;  // until_check: segments until the next look at the macrocells
int stream_rows = 0;                              // rows of segment stream_i that were taken already
float stream_offset = 0.0, s_a = 0.0, v_a = 0.0, s_b = 0.0, v_b = 0.0, s_c = 0.0, v_c = 0.0;
vec3 g_b = vec3(0.0), g_c = vec3(0.0), m_b = vec3(0.0), m_c = vec3(0.0);
bool stream_ready = false;  // this round completed a segment

float row_position(int row) {
  return frame_samples_ends != 0 ? steps_end(stream_i + row, stream_n, stream_L, stream_offset)
                                 : steps_centre(stream_i + row - frame_neighbours, stream_n, stream_L, stream_offset);
}
vec3 gradient_at(float s) { return sample_gradient(stream_o + stream_d * s); }

void stream_start(int x, int y) {
  if (frame_jitter_on != 0) stream_offset = jitter_offset(x, y);
  stream_n = steps_count(stream_L, stream_offset);
}

// True while segments are left: a march that ends with some left was cut by the driver.
bool stream_open() { return stream_i < stream_n; }

// Gradients, where a shaded source may lie between the values. Where both sides of a branch are run anyway, that of every
// back end is taken once and kept for the next front end; elsewhere only those that are needed.
void stream_gradients(inout segment q) {
#if DVR_EAGER_GRADIENTS
  g_b = g_c;
  g_c = gradient_at(frame_neighbours != 0 ? s_b : s_c);
  bool shaded = frame_samples_ends != 0 ? medium_shaded(v_b, v_c) : medium_shaded(q.v, q.v);
  if (shaded) {
    q.g = g_c;
    q.g0 = frame_samples_ends != 0 ? g_b : g_c;
    q.g1 = g_c;
  }
#else
  if (stream_ready && frame_samples_ends != 0) {
    if (medium_shaded(v_b, v_c)) {
      q.g0 = q.g = gradient_at(s_b);
      q.g1 = gradient_at(s_c);
    }
  } else if (stream_ready) {
    if (medium_shaded(q.v, q.v)) q.g = gradient_at(q.s);
  }
#endif
}

// The light volumes' values, likewise: that of every back end is kept for the next front end.
void stream_light(inout segment q) {
#if DVR_EAGER_GRADIENTS
  m_b = m_c;
  m_c = sample_light(stream_o + stream_d * (frame_neighbours != 0 ? s_b : s_c));
  q = segment_in_light(q, frame_samples_ends != 0 ? m_b : m_c, m_c);
#else
  if (stream_ready && frame_samples_ends != 0) {
    if (medium_lit(v_b, v_c)) q = segment_in_light(q, sample_light(stream_o + stream_d * s_b), sample_light(stream_o + stream_d * s_c));
  } else if (stream_ready) {
    vec3 m = vec3(0.0);
    if (medium_lit(q.v, q.v)) m = sample_light(stream_o + stream_d * q.s);
    q = segment_in_light(q, m, m);
  }
#endif
}

bool stream_next(inout segment q) {
  while (frame_skip != 0 && until_check == 0 && stream_i < stream_n) {
    int next = steps_leap(stream_i, stream_n, stream_L, stream_offset, stream_o, stream_d);
    if (next == stream_i) {
      until_check = 8;
    } else {
      stream_skipped += next - stream_i;
      stream_i = next;
      stream_rows = 0;
    }
  }
  if (stream_i >= stream_n) return false;
  int last = frame_samples_ends != 0 ? 1 : 2 * frame_neighbours;
  s_a = s_b; v_a = v_b;
  s_b = s_c; v_b = v_c;
  s_c = row_position(stream_rows);
  v_c = sample_value(stream_o + stream_d * s_c);
  stream_ready = stream_rows == last;
  q.s_prev = s_a; q.s0 = s_b; q.s1 = q.s_next = s_c;
  q.v_prev = v_a; q.v0 = v_b; q.v1 = q.v_next = v_c;
  q.s = frame_neighbours != 0 ? s_b : s_c;
  q.v = frame_neighbours != 0 ? v_b : v_c;
  q.g0 = q.g1 = q.g = vec3(0.0);
  if (frame_gradient != 0) stream_gradients(q);
  if (frame_lit != 0) stream_light(q);
  q.len = steps_length(stream_i, stream_n, stream_L, stream_offset);
  stream_rows = stream_ready ? last : stream_rows + 1;
  if (stream_ready) {
    --until_check;
    ++stream_i;
  }
  return true;
}
